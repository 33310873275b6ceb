#include "gpu/transfer.h"

#include <algorithm>

#include "gpu/device.h"

namespace vasa::gpu {
namespace {

constexpr std::size_t kStagingBytes = std::size_t(32) << 20;

void copy(VkCommandBuffer commands, const Buffer& from, const Buffer& to, VkBufferCopy region) {
  vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &region);
}

}  // namespace

void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> bytes, VkDeviceSize offset) {
  assert(offset + bytes.size() <= to.bytes());
  if (bytes.empty()) return;
  Buffer staging(device, {"staging", std::min(bytes.size(), kStagingBytes), MemoryRole::upload});
  while (!bytes.empty()) {
    const std::size_t part = std::min(bytes.size(), kStagingBytes);
    staging.write(bytes.first(part));
    Commands commands = device.queue().begin("upload");
    copy(commands, staging, to, {0, offset, part});
    device.queue().wait(device.queue().submit(std::move(commands)));
    bytes = bytes.subspan(part);
    offset += part;
  }
}

void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> bytes, VkDeviceSize offset) {
  assert(offset + bytes.size() <= from.bytes());
  if (bytes.empty()) return;
  const Buffer staging(device, {"staging", std::min(bytes.size(), kStagingBytes), MemoryRole::readBack});
  while (!bytes.empty()) {
    const std::size_t part = std::min(bytes.size(), kStagingBytes);
    Commands commands = device.queue().begin("download");
    copy(commands, from, staging, {offset, 0, part});
    device.queue().wait(device.queue().submit(std::move(commands)));
    staging.read(bytes.first(part));
    bytes = bytes.subspan(part);
    offset += part;
  }
}

}  // namespace vasa::gpu
