#include "gpu/adapter.h"

#include <algorithm>
#include <cctype>

#include "core/letters.h"
#include "gpu/error.h"
#include "gpu/features.h"
#include "gpu/instance.h"

namespace vasa::gpu {
namespace {

std::string versionText(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) +
         "." + std::to_string(VK_API_VERSION_PATCH(version));
}

// The better ones first.
constexpr std::pair<VkPhysicalDeviceType, const char*> kTypes[] = {
    {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "discrete"},
    {VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, "integrated"},
    {VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, "virtual"},
    {VK_PHYSICAL_DEVICE_TYPE_CPU, "cpu"}};

std::size_t placeOf(VkPhysicalDeviceType type) {
  return std::size_t(std::ranges::find(kTypes, type, [](const auto& own) { return own.first; }) - kTypes);
}

bool isBetter(const Adapter& a, const Adapter& b) {
  if (a.usable() != b.usable()) return a.usable();
  return placeOf(a.type) < placeOf(b.type);
}

void readDriver(VkPhysicalDevice device, Adapter& adapter) {
  VkPhysicalDeviceVulkan11Properties v11{};
  v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &v11;
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
  vkGetPhysicalDeviceProperties2(device, &properties);
  adapter.driver = driver.driverName;
  if (*driver.driverInfo)
    adapter.driver += std::string(adapter.driver.empty() ? "" : " ") + driver.driverInfo;
  adapter.driverId = driver.driverID;
  adapter.subgroup = v11.subgroupSize;
}

VkDeviceSize largestHeap(VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  VkDeviceSize largest = 0;
  for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount))
    if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) largest = std::max(largest, heap.size);
  return largest;
}

// One family that does everything keeps the queue ownership of every buffer trivial; all desktop drivers and
// lavapipe have one.
bool findQueueFamily(VkPhysicalDevice device, std::uint32_t& found) {
  constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const auto families = queueFamilies(device);
  const auto family = std::ranges::find_if(
      families, [](const VkQueueFamilyProperties& own) { return (own.queueFlags & needed) == needed; });
  if (family == families.end()) return false;
  found = std::uint32_t(family - families.begin());
  return true;
}

bool drawsTo(VkPhysicalDevice device, VkFormat format, VkFormatFeatureFlags use) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(device, format, &properties);
  return (properties.optimalTilingFeatures & use) == use;
}

void findMissingLimits(VkPhysicalDevice device, const VkPhysicalDeviceLimits& limits,
                       std::vector<std::string>& lacks) {
  // Workgroups have at most 128 threads, which Vulkan promises.
  const VkSampleCountFlags samples =
      limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  if (!(samples & VK_SAMPLE_COUNT_4_BIT)) lacks.emplace_back("4 samples a pixel");
  if (!drawsTo(device, VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT))
    lacks.emplace_back("32-bit depth");
}

std::string listText(std::span<const Adapter> adapters) {
  std::string text;
  for (const Adapter& adapter : adapters)
    text += (text.empty() ? "" : ", ") + std::to_string(adapter.index) + " = " + adapter.name;
  return text;
}

[[noreturn]] void refuse(std::string message) { throw Error({Fault::noDevice, std::move(message)}); }

}  // namespace

const char* typeName(VkPhysicalDeviceType type) {
  const std::size_t place = placeOf(type);
  return place < std::size(kTypes) ? kTypes[place].second : "other";
}

std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
  std::uint32_t count = 0;
  VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(result >= 0 ? count : 0);
  if (!devices.empty()) result = vkEnumeratePhysicalDevices(instance, &count, devices.data());
  // A driver is installed, but its device is not in this machine, or is not ours to open.
  if (result < 0 || count == 0)
    refuse("the installed Vulkan drivers find no device (vkEnumeratePhysicalDevices: " + resultName(result) +
           "); install mesa-vulkan-drivers or your GPU's driver, and check VK_DRIVER_FILES if it is set");
  devices.resize(count);
  return devices;
}

Adapter describe(VkPhysicalDevice device, std::uint32_t index) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  Adapter adapter;
  adapter.index = index;
  adapter.name = properties.deviceName;
  adapter.type = properties.deviceType;
  adapter.api = versionText(properties.apiVersion);
  adapter.limits = properties.limits;
  adapter.largestHeap = largestHeap(device);
  if (properties.apiVersion >= VK_API_VERSION_1_2) readDriver(device, adapter);
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    // Its feature structures may not be asked for.
    adapter.lacks.push_back("Vulkan 1.3 (has " + adapter.api + ")");
    return adapter;
  }
  Features offered;
  vkGetPhysicalDeviceFeatures2(device, offered.chain());
  adapter.lacks = missingFeatures(offered);
  adapter.without = unofferedFeatures(offered);
  if (!findQueueFamily(device, adapter.queueFamily))
    adapter.lacks.emplace_back("a queue that draws and computes");
  findMissingLimits(device, properties.limits, adapter.lacks);
  return adapter;
}

std::vector<Adapter> listAdapters() {
  const Instance instance({});
  std::vector<Adapter> adapters;
  for (VkPhysicalDevice device : physicalDevices(instance.handle()))
    adapters.push_back(describe(device, std::uint32_t(adapters.size())));
  return adapters;
}

std::size_t chooseAdapter(std::span<const Adapter> adapters, std::string_view choice) {
  const bool byIndex = !choice.empty() && std::all_of(choice.begin(), choice.end(),
                                                      [](unsigned char c) { return std::isdigit(c); });
  const std::string wanted = lowerCase(choice);
  const Adapter* best = nullptr;
  for (const Adapter& adapter : adapters) {
    const bool matches = byIndex ? std::to_string(adapter.index) == wanted
                                 : lowerCase(adapter.name).find(wanted) != std::string::npos;
    if (matches && (!best || isBetter(adapter, *best))) best = &adapter;
  }
  if (!best)
    refuse("no Vulkan device matches --device " + std::string(choice) + "; there is " + listText(adapters));
  if (!best->usable()) {
    std::string lacks;
    for (const std::string& what : best->lacks) lacks += (lacks.empty() ? "" : ", ") + what;
    refuse("Vulkan device " + std::to_string(best->index) + " (" + best->name + ") lacks " + lacks +
           "; update its driver or choose another device (vasa devices lists them)");
  }
  return std::size_t(best - adapters.data());
}

}  // namespace vasa::gpu
