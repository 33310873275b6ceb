#pragma once
#include "gpu/unique.h"

// Handles that only windows and render passes need, for Unique and Device::setName(). Those are templates
// that find these functions by argument-dependent lookup: Vulkan's types belong to the global namespace, so
// the functions do too.

inline void destroyHandle(VkDevice device, VkSwapchainKHR handle) {
  vkDestroySwapchainKHR(device, handle, nullptr);
}
inline void destroyHandle(VkDevice device, VkRenderPass handle) {
  vkDestroyRenderPass(device, handle, nullptr);
}
inline void destroyHandle(VkDevice device, VkFramebuffer handle) {
  vkDestroyFramebuffer(device, handle, nullptr);
}
constexpr VkObjectType objectType(VkSwapchainKHR) { return VK_OBJECT_TYPE_SWAPCHAIN_KHR; }
constexpr VkObjectType objectType(VkRenderPass) { return VK_OBJECT_TYPE_RENDER_PASS; }
constexpr VkObjectType objectType(VkFramebuffer) { return VK_OBJECT_TYPE_FRAMEBUFFER; }
