#pragma once
#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace vasa::gpu {

/// The feature structures of Vulkan 1.0 to 1.3, to be asked of a device or enabled on it.
struct Features {
  VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, nullptr, {}};
  VkPhysicalDeviceVulkan11Features v11{};
  VkPhysicalDeviceVulkan12Features v12{};
  VkPhysicalDeviceVulkan13Features v13{};

  Features();
  /// The head of the chain, linked anew: a copy's links would point into the original.
  VkPhysicalDeviceFeatures2* chain();
};

/// What vasa cannot do without, by Vulkan's names; Vulkan 1.3 promises all of it.
std::vector<std::string> missingFeatures(Features& offered);

/// What vasa uses where it is, but can do without.
std::vector<std::string> unofferedFeatures(Features& offered);

/// The required features, and of the others vasa can use (or the validation layers want) those on offer.
Features featuresToEnable(Features& offered);

}  // namespace vasa::gpu
