#pragma once
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/unique.h"

namespace vasa::gpu {

/// What a device's pipeline cache is kept by: vendor, device, driver and what the driver says of its caches.
std::uint64_t pipelineKey(const VkPhysicalDeviceProperties& properties);

/// Whether bytes are what this driver's vkGetPipelineCacheData gave on this device, by the header that Vulkan
/// puts before them, and hold anything beyond it: lavapipe and SwiftShader give the header alone.
bool isCacheOf(std::span<const std::byte> bytes, const VkPhysicalDeviceProperties& properties);

/// What a driver compiles, kept from run to run (core/kept.h), a file a driver and device. Drivers that have
/// a cache of their own on disk give nothing to keep, and nothing is.
class PipelineStore {
 public:
  PipelineStore() = default;
  /// With what an earlier run kept, where there is any that the driver takes.
  PipelineStore(VkDevice device, const VkPhysicalDeviceProperties& properties);

  VkPipelineCache handle() const { return cache_.get(); }
  /// Keeps what is there by now, if it is not what was found.
  void keep() const;

 private:
  VkPhysicalDeviceProperties properties_{};
  std::uint64_t found_ = 0;  // hash of what was found
  VkDevice device_ = VK_NULL_HANDLE;
  Unique<VkPipelineCache> cache_;
};

}  // namespace vasa::gpu
