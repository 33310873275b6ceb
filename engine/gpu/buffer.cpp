#include "gpu/buffer.h"

#include <algorithm>
#include <string>

#include "gpu/make.h"

namespace vasa::gpu {
namespace {

// An index buffer or the commands of indirect draws are written by compute shaders, so a buffer's uses are
// seldom known apart; on desktop drivers the flags cost nothing.
constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                      VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
constexpr VkDeviceSize kSmallest = 16;

}  // namespace

Buffer::Buffer(Device& device, const BufferSpec& spec) : bytes_(spec.bytes) {
  const VkDeviceSize most = device.limits().maxStorageBufferRange;
  if (spec.bytes > most)
    throw Error(
        {Fault::failed,
         std::string(spec.name) + ": " + std::to_string(spec.bytes) + " bytes, more than the " +
             std::to_string(most) + " that the device lets a shader reach; use " +
             (spec.role == MemoryRole::readBack ? "a smaller picture or window" : "fewer quads or vessels")});
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = std::max(spec.bytes, kSmallest);
  info.usage = kUsage | spec.moreUsage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  buffer_ = make(device, vkCreateBuffer, "vkCreateBuffer", info, spec.name);
  const VkBuffer buffer = buffer_.get();
  memory_ = allocate(device, buffer, spec.role, spec.name);
  VkBufferDeviceAddressInfo addressInfo{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer};
  address_ = vkGetBufferDeviceAddress(device.handle(), &addressInfo);
  settled_ = Settled(device.queue());
  assert(address_ % 16 == 0);
  if (AddressMap* map = device.addresses()) known_ = map->add(address_, info.size, buffer);
}

void Buffer::writeBytes(const void* data, std::size_t bytes, VkDeviceSize offset) {
  assert(memory_.mapped() && offset + bytes <= bytes_);
  if (bytes == 0) return;
  std::memcpy(memory_.mapped() + offset, data, bytes);
  memory_.flush(offset, bytes);
}

void Buffer::readBytes(void* data, std::size_t bytes, VkDeviceSize offset) const {
  assert(memory_.mapped() && offset + bytes <= bytes_);
  if (bytes == 0) return;
  memory_.invalidate(offset, bytes);
  std::memcpy(data, memory_.mapped() + offset, bytes);
}

}  // namespace vasa::gpu
