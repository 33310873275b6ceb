#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

#include <vasa/gpu/features.h>

/// Stands for a program that has a Vulkan device of its own: what such a program does anyway.
/// Only one line of it is there for vasa's sake: which features it switches on.
class Host {
 public:
  Host();
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Copies an image in TRANSFER_SRC layout, 4 bytes a pixel, to memory, with commands and a buffer of the
  /// host's own.
  std::vector<std::uint8_t> read(VkImage image, std::uint32_t width, std::uint32_t height);

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queueFamily = 0;
  vasa::gpu::Features enabled;

 private:
  void chooseDevice();
  void makeDevice();
  std::uint32_t readableMemory(std::uint32_t types) const;
  VkCommandPool pool_ = VK_NULL_HANDLE;
};
