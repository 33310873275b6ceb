#pragma once
#include "gpu/compute_pipeline.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/target.h"
#include "render/occlusion.h"

namespace vasa {

/// Ambient occlusion of what is drawn so far, from the target's depth. CPU reference: render/occlusion.h.
class OcclusionPass {
 public:
  /// @param target  with TargetSpec::readDepth
  OcclusionPass(gpu::Device& device, const gpu::Target& target);

  /// Between two stretches of the picture: finds the occlusion. Barriers included.
  void record(VkCommandBuffer commands, const gpu::Target& target, const Camera& camera, float reach, float strength) const;
  /// Within the next stretch: takes it off the picture's colours.
  void recordApply(VkCommandBuffer commands, const gpu::Target& target) const;

  const gpu::Buffer& depth() const { return depth_; }
  const gpu::Buffer& raw() const { return raw_; }
  const gpu::Buffer& light() const { return light_; }

 private:
  gpu::ComputePipeline find_, smooth_;
  gpu::GraphicsPipeline apply_;
  gpu::Buffer depth_, raw_, light_;  // a float a pixel each
};

}  // namespace vasa
