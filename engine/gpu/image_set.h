#pragma once
#include <vulkan/vulkan.h>

#include <vector>

#include "gpu/image.h"
#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// Images that fragment shaders read texel by texel: set 0, binding k of pipelines made with layout(). The
/// images must stay, in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL or, of depth, kReadDepthLayout (target.h)
/// while they are read.
class ImageSet {
 public:
  ImageSet(Device& device, const char* name, const std::vector<const Image*>& images);

  const VkDescriptorSetLayout& layout() const { return layout_.get(); }
  void bind(VkCommandBuffer commands, VkPipelineLayout pipeline) const;

 private:
  Unique<VkDescriptorSetLayout> layout_;
  Unique<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  // goes with its pool
};

}  // namespace vasa::gpu
