#include "collide/kernels.h"

// The same code for one lane: what the vectors are held against.
#define HWY_COMPILE_ONLY_SCALAR
#include "collide/kernels-inl.h"

namespace vasa {

const Kernels& scalarKernels() {
  namespace scalar = HWY_NAMESPACE;
  static const Kernels kernels{scalar::fitLeaves, scalar::fitLevel,     scalar::openNode,
                               scalar::traverse,  scalar::meetCapsules, scalar::narrow};
  return kernels;
}

}  // namespace vasa
