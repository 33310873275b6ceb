#include "render/frame_stages.h"

#include <string_view>

namespace vasa::stage {

void addTo(FrameTimes& times, gpu::GpuTimer& timer) {
  for (const auto& [name, ms] : timer.results()) {
    const std::string_view stage(name);
    (stage == kTessellate    ? times.tessellate
     : stage == kForks       ? times.forks
     : stage == kDraw        ? times.draw
     : stage == kCapillaries ? times.capillaries
                             : times.meshes) += ms;
  }
}

}  // namespace vasa::stage
