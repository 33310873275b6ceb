#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vasa::gpu {

/// A Vulkan device of this machine as seen from outside: what it is and what it lacks for vasa.
struct Adapter {
  std::uint32_t index = 0;  ///< its place in the driver's list; `--device` takes it
  std::string name;         ///< "NVIDIA RTX A2000", "llvmpipe (LLVM 15.0.6, 256 bits)"
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  std::string api;     ///< "1.3.230"
  std::string driver;  ///< "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
  VkDriverId driverId = VkDriverId(0);
  std::vector<std::string> lacks;  ///< features by Vulkan's names, and limits in words
  std::vector<std::string>
      without;  ///< features that vasa uses where they are (README says what each is good for)
  VkPhysicalDeviceLimits limits{};
  std::uint32_t subgroup = 0;     ///< threads of a subgroup
  VkDeviceSize largestHeap = 0;   ///< [bytes] of its own memory
  std::uint32_t queueFamily = 0;  ///< draws, computes and copies

  bool usable() const { return lacks.empty(); }
};

/// "discrete", "integrated", "virtual", "cpu" or "other".
const char* typeName(VkPhysicalDeviceType type);

/// Every device of the instance, in the order of the driver's list.
/// Throws Error (Fault::noDevice) if there is none or the drivers cannot say.
std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance);
Adapter describe(VkPhysicalDevice device, std::uint32_t index);
std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice device);

/// The devices of this machine. Makes an instance for the time of the call.
/// Throws Error (Fault::noDevice) if there is no driver or no device.
std::vector<Adapter> listAdapters();

/// The position in `adapters` of the device to use. An empty choice takes the first usable one of the best
/// type, in the order discrete, integrated, virtual, cpu, other. Digits alone are an index; any other choice
/// is a part of the name in any case, and the best match counts.
/// Throws Error (Fault::noDevice) with the list of what there is, or of what the chosen device lacks.
std::size_t chooseAdapter(std::span<const Adapter> adapters, std::string_view choice);

}  // namespace vasa::gpu
