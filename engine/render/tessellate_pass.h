#pragma once
#include "gpu/compute_pipeline.h"
#include "render/tube_set.h"

namespace vasa {

/// Writes the vertices of a batch of sweeps or caps. CPU reference: surface/tessellate.h.
class TessellatePass {
 public:
  explicit TessellatePass(gpu::Device& device);

  struct Input {
    const TubeSet& tubes;
    const TubeBatch& batch;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
    VkDeviceAddress vertices;       ///< takes the batch's shared::TubeVertex, item after item
  };
  /// No barriers: the caller keeps readers of the vertices apart.
  void record(VkCommandBuffer commands, const Input& input) const;

 private:
  gpu::ComputePipeline sweeps_, caps_;
};

}  // namespace vasa
