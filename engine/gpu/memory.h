#pragma once
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// What memory is for. Code never asks for memory properties: on lavapipe one type is everything at once, so
/// a wrong property would only show on a real GPU.
enum class MemoryRole {
  device,    ///< read and written by the device; the host reaches it by copies only
  upload,    ///< written by the host, in order, read once by the device
  readBack,  ///< written by the device, read by the host
};

/// The memory types that can serve `role` and are among `typeBits`, best first; empty if none can.
/// device: local, out of the host's sight if possible (that window is small on many GPUs). upload: visible,
/// coherent and uncached if possible. readBack: visible, cached if possible. Never protected or lazily
/// allocated memory, nor the uncached types of VK_AMD_device_coherent_memory.
std::vector<std::uint32_t> rankMemoryTypes(const VkPhysicalDeviceMemoryProperties& memory,
                                           std::uint32_t typeBits, MemoryRole role);

/// The memory of one buffer or image: an allocation of its own. The engine makes few and large ones, far from
/// the 4,096 that every device grants. Visible roles are mapped for good.
class Memory {
 public:
  Memory() = default;
  Memory(Memory&&) = default;
  Memory& operator=(Memory&&) = default;

  VkDeviceMemory handle() const { return memory_.get(); }
  std::byte* mapped() const { return mapped_; }  ///< nullptr for MemoryRole::device
  VkDeviceSize bytes() const {
    return size_;
  }  ///< as the device needs them: GPUs ask for some more than was wanted

  /// Makes host writes to a range reach the device, and device writes the host. For coherent memory both do
  /// nothing.
  void flush(VkDeviceSize offset, VkDeviceSize bytes) const;
  void invalidate(VkDeviceSize offset, VkDeviceSize bytes) const;

 private:
  friend Memory allocate(Device&, VkBuffer, MemoryRole, std::string_view);
  friend Memory allocate(Device&, VkImage, std::string_view);
  Memory(Device& device, const VkMemoryRequirements& needs, VkMemoryDedicatedAllocateInfo owner,
         MemoryRole role, std::string_view name);
  VkMappedMemoryRange range(VkDeviceSize offset, VkDeviceSize bytes) const;

  VkDevice device_ = VK_NULL_HANDLE;
  Unique<VkDeviceMemory> memory_;
  std::byte* mapped_ = nullptr;
  VkDeviceSize size_ = 0;
  VkDeviceSize atom_ = 1;
  bool coherent_ = true;
};

/// Allocates and binds. Throws Error when no type fits or the memory is spent.
Memory allocate(Device& device, VkBuffer buffer, MemoryRole role, std::string_view name);
Memory allocate(Device& device, VkImage image, std::string_view name);  ///< MemoryRole::device

}  // namespace vasa::gpu
