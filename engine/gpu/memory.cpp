#include "gpu/memory.h"

#include <algorithm>
#include <string>

#include "gpu/device.h"
#include "gpu/error.h"

namespace vasa::gpu {
namespace {

struct Wish {
  VkMemoryPropertyFlags needed;
  VkMemoryPropertyFlags liked;
  VkMemoryPropertyFlags disliked;
};

Wish wishOf(MemoryRole role) {
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
  constexpr VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  switch (role) {
    case MemoryRole::upload:
      return {visible, coherent, cached | local};
    case MemoryRole::readBack:
      return {visible, cached, local};
    default:
      return {0, local, visible};
  }
}

// Being liked outweighs being disliked: device memory that the host can see beats memory across the bus.
int score(VkMemoryPropertyFlags flags, const Wish& wish) {
  const auto count = [](VkMemoryPropertyFlags bits) {
    int set = 0;
    for (; bits; bits &= bits - 1) ++set;
    return set;
  };
  return 8 * count(flags & wish.liked) - count(flags & wish.disliked);
}

constexpr VkMemoryPropertyFlags kForbidden =
    VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
    VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;

}  // namespace

std::vector<std::uint32_t> rankMemoryTypes(const VkPhysicalDeviceMemoryProperties& memory,
                                           std::uint32_t typeBits, MemoryRole role) {
  const Wish wish = wishOf(role);
  const auto flags = [&](std::uint32_t type) { return memory.memoryTypes[type].propertyFlags; };
  std::vector<std::uint32_t> types;
  for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    const bool allowed = (typeBits >> type & 1u) != 0;
    if (allowed && (flags(type) & wish.needed) == wish.needed && !(flags(type) & kForbidden))
      types.push_back(type);
  }
  // Stable: among equals, drivers list the faster type first.
  std::stable_sort(types.begin(), types.end(), [&](std::uint32_t a, std::uint32_t b) {
    return score(flags(a), wish) > score(flags(b), wish);
  });
  return types;
}

Memory::Memory(Device& device, const VkMemoryRequirements& needs, VkMemoryDedicatedAllocateInfo owner,
               MemoryRole role, std::string_view name)
    : device_(device.handle()), size_(needs.size), atom_(device.limits().nonCoherentAtomSize) {
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.pNext = &owner;
  flags.flags = owner.buffer ? VkMemoryAllocateFlags(VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT) : 0;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = &flags;
  info.allocationSize = needs.size;

  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (std::uint32_t type : rankMemoryTypes(device.memory(), needs.memoryTypeBits, role)) {
    info.memoryTypeIndex = type;
    result = vkAllocateMemory(device_, &info, nullptr, &memory);
    coherent_ = device.memory().memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;  // else the next heap may have room
  }
  check(result,
        ("vkAllocateMemory of " + std::to_string(needs.size) + " bytes for " + std::string(name)).c_str());
  memory_ = {device_, memory};
  device.setName(memory, name);
  if (role == MemoryRole::device) return;
  void* address = nullptr;
  check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &address), "vkMapMemory");
  mapped_ = static_cast<std::byte*>(address);
}

// Ranges of non-coherent memory begin and end at multiples of the atom, or at the allocation's end.
VkMappedMemoryRange Memory::range(VkDeviceSize offset, VkDeviceSize bytes) const {
  const VkDeviceSize begin = offset / atom_ * atom_;
  const VkDeviceSize end = std::min((offset + bytes + atom_ - 1) / atom_ * atom_, size_);
  return {VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, memory_.get(), begin, end - begin};
}

void Memory::flush(VkDeviceSize offset, VkDeviceSize bytes) const {
  if (coherent_ || bytes == 0) return;
  const VkMappedMemoryRange touched = range(offset, bytes);
  check(vkFlushMappedMemoryRanges(device_, 1, &touched), "vkFlushMappedMemoryRanges");
}

void Memory::invalidate(VkDeviceSize offset, VkDeviceSize bytes) const {
  if (coherent_ || bytes == 0) return;
  const VkMappedMemoryRange touched = range(offset, bytes);
  check(vkInvalidateMappedMemoryRanges(device_, 1, &touched), "vkInvalidateMappedMemoryRanges");
}

Memory allocate(Device& device, VkBuffer buffer, MemoryRole role, std::string_view name) {
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
  VkMemoryDedicatedAllocateInfo owner{};
  owner.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  owner.buffer = buffer;
  Memory memory(device, needs, owner, role, name);
  check(vkBindBufferMemory(device.handle(), buffer, memory.handle(), 0), "vkBindBufferMemory");
  return memory;
}

Memory allocate(Device& device, VkImage image, std::string_view name) {
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device.handle(), image, &needs);
  VkMemoryDedicatedAllocateInfo owner{};
  owner.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  owner.image = image;
  Memory memory(device, needs, owner, MemoryRole::device, name);
  check(vkBindImageMemory(device.handle(), image, memory.handle(), 0), "vkBindImageMemory");
  return memory;
}

}  // namespace vasa::gpu
