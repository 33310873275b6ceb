#pragma once
#include <vulkan/vulkan.h>

#include <vector>

#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// Images that fragment shaders read texel by texel: set 0, binding k of pipelines made with layout(). The images must
/// stay, in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL or, of depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL while
/// they are read.
class ImageSet {
 public:
  struct Entry {
    VkImageView view = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  };
  ImageSet(Device& device, const char* name, const std::vector<Entry>& images);

  const VkDescriptorSetLayout& layout() const { return handle_; }
  void bind(VkCommandBuffer commands, VkPipelineLayout pipeline) const;

 private:
  Unique<VkDescriptorSetLayout> layout_;
  VkDescriptorSetLayout handle_ = VK_NULL_HANDLE;  // of layout_, where a pipeline's making finds it
  Unique<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  // goes with its pool
};

}  // namespace vasa::gpu
