#pragma once
#include "gpu/compute_pipeline.h"
#include "render/camera.h"
#include "render/look.h"
#include "render/tube_set.h"
#include "surface/detail.h"

namespace vasa {

/// What a frame's picture asks of the network's tessellation.
shared::DetailView detailView(const Camera& camera, const Look& look, const PictureGrid& grid,
                              const TubeDetail& detail);
/// @param samples  a pixel: 1 or 4
PictureGrid pictureGrid(const gpu::Device& device, VkExtent2D size, std::uint32_t samples = 1);

/// Chooses m of each vessel and n of each sweep by the rule of surface/detail.h. Owns what it writes, for
/// every pass that has to match the tubes' rings. CPU reference: tests/reference/detail.h.
class DetailPass {
 public:
  DetailPass(gpu::Device& device, const TubeSet& tubes);

  /// For other tubes from now on; what is compiled stays.
  void fit(gpu::Device& device, const TubeSet& tubes);

  /// Barriers included: later compute passes see what it wrote.
  /// @param points  de Boor points (vec4) of the frame
  void record(VkCommandBuffer commands, const TubeSet& tubes, VkDeviceAddress points,
              const shared::DetailView& view) const;

  VkDeviceAddress view() const { return view_.address(); }      ///< shared::DetailView
  VkDeviceAddress along() const { return along_.address(); }    ///< n of each sweep, 0: not drawn
  VkDeviceAddress around() const { return around_.address(); }  ///< m of each vessel
  const gpu::Buffer& alongBuffer() const { return along_; }
  const gpu::Buffer& aroundBuffer() const { return around_; }

 private:
  gpu::ComputePipeline measure_, choose_;
  gpu::Buffer view_, along_, sizes_, around_;
};

}  // namespace vasa
