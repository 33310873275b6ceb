#pragma once
#include <vulkan/vulkan.h>

#include <utility>

namespace vasa::gpu {

// How each kind of handle ends, and what Vulkan calls its kind (for debug names).
#define VASA_GPU_HANDLE(Handle, Destroy, ObjectType)                                              \
  inline void destroyHandle(VkDevice device, Handle handle) { Destroy(device, handle, nullptr); } \
  constexpr VkObjectType objectType(Handle) { return ObjectType; }

VASA_GPU_HANDLE(VkBuffer, vkDestroyBuffer, VK_OBJECT_TYPE_BUFFER)
VASA_GPU_HANDLE(VkImage, vkDestroyImage, VK_OBJECT_TYPE_IMAGE)
VASA_GPU_HANDLE(VkImageView, vkDestroyImageView, VK_OBJECT_TYPE_IMAGE_VIEW)
VASA_GPU_HANDLE(VkSampler, vkDestroySampler, VK_OBJECT_TYPE_SAMPLER)
VASA_GPU_HANDLE(VkDeviceMemory, vkFreeMemory, VK_OBJECT_TYPE_DEVICE_MEMORY)
VASA_GPU_HANDLE(VkShaderModule, vkDestroyShaderModule, VK_OBJECT_TYPE_SHADER_MODULE)
VASA_GPU_HANDLE(VkPipelineLayout, vkDestroyPipelineLayout, VK_OBJECT_TYPE_PIPELINE_LAYOUT)
VASA_GPU_HANDLE(VkPipeline, vkDestroyPipeline, VK_OBJECT_TYPE_PIPELINE)
VASA_GPU_HANDLE(VkPipelineCache, vkDestroyPipelineCache, VK_OBJECT_TYPE_PIPELINE_CACHE)
VASA_GPU_HANDLE(VkDescriptorSetLayout, vkDestroyDescriptorSetLayout, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT)
VASA_GPU_HANDLE(VkDescriptorPool, vkDestroyDescriptorPool, VK_OBJECT_TYPE_DESCRIPTOR_POOL)
VASA_GPU_HANDLE(VkCommandPool, vkDestroyCommandPool, VK_OBJECT_TYPE_COMMAND_POOL)
VASA_GPU_HANDLE(VkSemaphore, vkDestroySemaphore, VK_OBJECT_TYPE_SEMAPHORE)
VASA_GPU_HANDLE(VkQueryPool, vkDestroyQueryPool, VK_OBJECT_TYPE_QUERY_POOL)
VASA_GPU_HANDLE(VkSwapchainKHR, vkDestroySwapchainKHR, VK_OBJECT_TYPE_SWAPCHAIN_KHR)
VASA_GPU_HANDLE(VkRenderPass, vkDestroyRenderPass, VK_OBJECT_TYPE_RENDER_PASS)
VASA_GPU_HANDLE(VkFramebuffer, vkDestroyFramebuffer, VK_OBJECT_TYPE_FRAMEBUFFER)
#undef VASA_GPU_HANDLE

constexpr VkObjectType objectType(VkCommandBuffer) { return VK_OBJECT_TYPE_COMMAND_BUFFER; }

/// The owner of one handle that belongs to a VkDevice. Move-only. Destroys at once: keep it
/// until the device has finished with it.
template <class Handle>
class Unique {
 public:
  Unique() = default;
  Unique(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
  Unique(Unique&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, Handle(VK_NULL_HANDLE))) {}
  Unique& operator=(Unique&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Unique() {
    if (handle_) destroyHandle(device_, handle_);
  }

  const Handle& get() const { return handle_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
};

}  // namespace vasa::gpu
