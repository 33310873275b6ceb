#pragma once
#include "gpu/compute_pipeline.h"
#include "render/detail_pass.h"
#include "render/filling.h"

namespace vasa {

/// Turns sweeps, with their caps, into triangles, and leaves out those that cannot be seen.
/// CPU references: surface/tessellate.h, tests/reference/visible.h.
class TubePass {
 public:
  /// @param samples  of the picture: 1 or 4 a pixel
  /// @param tubes    read, not kept: of a network that it will write
  TubePass(gpu::Device& device, std::uint32_t samples, const TubeSet& tubes);

  struct Input {
    const TubeSet& tubes;
    const DetailPass& detail;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
    const Filling& filling;
    const Template& into;
    bool cull = true;  ///< false: every triangle is drawn
  };
  /// A round's sweeps, as far as there is room. No barriers.
  void record(VkCommandBuffer commands, const Input& input) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
