#include "gpu/features.h"

#include <span>

namespace vasa::gpu {
namespace {

struct Feature {
  const char* name;
  VkBool32& (*at)(Features&);
};

#define VASA_FEATURE(group, name)                                 \
  Feature {                                                       \
#name, [](Features & f) -> VkBool32& { return f.group.name; } \
  }

const Feature kRequired[] = {
    VASA_FEATURE(v12, bufferDeviceAddress), VASA_FEATURE(v12, timelineSemaphore),
    VASA_FEATURE(v13, dynamicRendering),    VASA_FEATURE(v13, synchronization2),
    VASA_FEATURE(v13, maintenance4),
};

// shaderInt64, the stores and atomics are what GPU-assisted validation writes its findings with.
const Feature kWelcome[] = {
    VASA_FEATURE(core.features, shaderInt64),  // without: a tenth more time a frame on a CPU device
    VASA_FEATURE(core.features, fragmentStoresAndAtomics),
    VASA_FEATURE(core.features, vertexPipelineStoresAndAtomics),
    VASA_FEATURE(core.features, fillModeNonSolid),
    VASA_FEATURE(core.features, wideLines),
    VASA_FEATURE(v12, vulkanMemoryModel),
    VASA_FEATURE(v12, vulkanMemoryModelDeviceScope),
    VASA_FEATURE(v13, shaderDemoteToHelperInvocation),
};

#undef VASA_FEATURE

std::vector<std::string> notIn(Features& offered, std::span<const Feature> features) {
  std::vector<std::string> names;
  for (const Feature& feature : features)
    if (!feature.at(offered)) names.emplace_back(feature.name);
  return names;
}

}  // namespace

Features::Features() {
  v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
  v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
}

VkPhysicalDeviceFeatures2* Features::chain() {
  core.pNext = &v11;
  v11.pNext = &v12;
  v12.pNext = &v13;
  v13.pNext = nullptr;
  return &core;
}

std::vector<std::string> missingFeatures(Features& offered) { return notIn(offered, kRequired); }

std::vector<std::string> unofferedFeatures(Features& offered) { return notIn(offered, kWelcome); }

Features featuresToEnable(Features& offered) {
  Features enabled;
  for (const Feature& feature : kRequired) feature.at(enabled) = VK_TRUE;
  for (const Feature& feature : kWelcome) feature.at(enabled) = feature.at(offered);
  return enabled;
}

}  // namespace vasa::gpu
