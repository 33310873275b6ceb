#include "collide/kernels.h"

// Highway includes this file again for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collide/kernels.cpp"
#include <hwy/foreach_target.h>

#include "collide/kernels-inl.h"

#if HWY_ONCE
namespace vasa {

HWY_EXPORT(fitLeaves);
HWY_EXPORT(fitLevel);
HWY_EXPORT(openNode);
HWY_EXPORT(traverse);
HWY_EXPORT(meetCapsules);
HWY_EXPORT(narrow);

const Kernels& fastKernels() {
  static const Kernels kernels = [] {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return Kernels{&HWY_DYNAMIC_DISPATCH(fitLeaves),    &HWY_DYNAMIC_DISPATCH(fitLevel),
                   &HWY_DYNAMIC_DISPATCH(openNode),     &HWY_DYNAMIC_DISPATCH(traverse),
                   &HWY_DYNAMIC_DISPATCH(meetCapsules), &HWY_DYNAMIC_DISPATCH(narrow)};
  }();
  return kernels;
}

}  // namespace vasa
#endif
