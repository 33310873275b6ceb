#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>

namespace vasa::gpu {

/// What a device's pipeline cache is kept by: vendor, device, driver and what the driver says of its caches.
std::uint64_t pipelineKey(const VkPhysicalDeviceProperties& properties);

}  // namespace vasa::gpu
