#pragma once
#include "gpu/compute_pipeline.h"
#include "render/detail_pass.h"

namespace vasa {

/// What a batch's tubes or forks become: vertices, a colour for each block of them, indices of the triangles to draw, and
/// a draw a group.
struct TubeDraws {
  TubeDraws() = default;
  TubeDraws(gpu::Device& device, const GroupRoom& room, std::uint32_t groups);
  VkDeviceSize bytes() const;

  gpu::Buffer vertices, colours, indices, draws;  ///< shared::TubeVertex, uint, uint, shared::DrawCommand
};

/// Turns a batch of sweeps, with their caps, into triangles, and leaves out those that cannot be seen.
/// CPU references: surface/tessellate.h, surface/visible.h.
class TubePass {
 public:
  /// @param samples  of the picture: 1 or 4 a pixel
  TubePass(gpu::Device& device, std::uint32_t samples);

  struct Input {
    const TubeSet& tubes;
    const TubeBatch& batch;
    const DetailPass& detail;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
    const TubeDraws& draws;
    bool cull = true;  ///< false: every triangle is drawn
  };
  /// No barriers.
  void record(VkCommandBuffer commands, const Input& input) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
