#pragma once
#include <vector>

#include "render/fork_pass.h"
#include "render/surface_pass.h"

namespace vasa {

/// Every vertex and index of a network's tubes, caps and forks at once: what a drawing without templates
/// would hold. Only for comparison with the renderer.
class StaticTubes {
 public:
  StaticTubes(gpu::Device& device, const TubeSet& tubes, const ForkSet& forks);

  /// Fills the buffers, with every triangle, and makes drawing see them.
  void recordVertices(VkCommandBuffer commands, const TubePass& pass, const ForkPass& forkPass,
                      const PlanPass& plan, const DetailPass& detail, VkDeviceAddress points,
                      VkDeviceAddress knots) const;
  /// Draws them, between Target::begin() and end().
  void recordDraw(VkCommandBuffer commands, const SurfacePass& pass, const shared::DrawPush& push) const;

 private:
  struct Part {
    FillRange range;
    Filling filling;
    Template made;
  };
  void add(gpu::Device& device, const FillRange& range);

  const TubeSet& tubes_;
  const ForkSet& forks_;
  std::vector<Part> parts_;
};

}  // namespace vasa
