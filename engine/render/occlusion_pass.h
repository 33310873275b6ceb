#pragma once
#include "gpu/graphics_pipeline.h"
#include "gpu/image_set.h"
#include "gpu/target.h"
#include "render/camera.h"
#include "shared/occlusion.h"

namespace vasa {

/// How places follow from a picture's depth, and how far occlusion reaches.
/// @param reach     [m]
/// @param strength  0 to 1
shared::OcclusionPush occlusionConstants(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                         float reach, float strength);

/// Ambient occlusion of what is drawn so far, from the target's depth. CPU reference:
/// tests/reference/occlusion.h.
/// Fragment shaders behind a depth test, not compute: a CPU device leaves out where nothing is drawn.
class OcclusionPass {
 public:
  /// @param target  with TargetSpec::readDepth; must stay
  OcclusionPass(gpu::Device& device, const gpu::Target& target);

  /// For pictures of another size, from a target that is else the same. Pipelines stay.
  void resize(gpu::Device& device, const gpu::Target& target);

  /// Between two stretches of the picture, a stretch of its own: finds the occlusion and takes it off the
  /// picture's colours. A barrier from and to gpu::kAttachmentStages belongs behind it.
  void record(VkCommandBuffer commands, const gpu::Target& target, const Camera& camera, float reach,
              float strength) const;

  /// What was found, before and after it is smoothed: a float a pixel, in
  /// VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
  const gpu::Image& raw() const { return images_.raw; }
  const gpu::Image& light() const { return images_.light; }

 private:
  struct Images {
    Images(gpu::Device& device, const gpu::Target& target);
    gpu::Image raw, light;
    gpu::ImageSet find, smooth, apply;
  };
  Images images_;
  gpu::GraphicsPipeline find_, smooth_, apply_;
};

}  // namespace vasa
