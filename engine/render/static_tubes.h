#pragma once
#include "render/surface_pass.h"
#include "render/tessellate_pass.h"

namespace vasa {

/// Every vertex of a network's tubes and caps at once: what a drawing without templates would hold. Only for
/// comparison with the renderer.
class StaticTubes {
 public:
  StaticTubes(gpu::Device& device, const TubeSet& tubes);

  /// Fills the buffers, and makes vertex fetch see them.
  void recordVertices(VkCommandBuffer commands, const TessellatePass& pass, VkDeviceAddress points,
                      VkDeviceAddress knots) const;
  /// Draws them, between Target::begin() and end().
  void recordDraw(VkCommandBuffer commands, const SurfacePass& pass, const shared::DrawPush& push) const;

 private:
  struct Place {
    std::size_t buffer;
    VkDeviceSize offset;
  };
  const TubeSet& tubes_;
  std::vector<gpu::Buffer> buffers_;  // several, as a device limits the size of one
  std::vector<Place> places_;         // one a batch
};

}  // namespace vasa
