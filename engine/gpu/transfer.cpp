#include "gpu/transfer.h"

#include <algorithm>

#include "gpu/device.h"

namespace vasa::gpu {
namespace {

constexpr std::size_t kStagingBytes = std::size_t(32) << 20;

}  // namespace

void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> bytes, VkDeviceSize offset) {
  assert(offset + bytes.size() <= to.bytes());
  if (bytes.empty()) return;
  Buffer staging(device, {"staging", std::min(bytes.size(), kStagingBytes), MemoryRole::upload});
  while (!bytes.empty()) {
    const std::size_t part = std::min(bytes.size(), kStagingBytes);
    staging.write(bytes.first(part));
    Commands commands = device.queue().begin("upload");
    const VkBufferCopy region{0, offset, part};
    vkCmdCopyBuffer(commands, staging.handle(), to.handle(), 1, &region);
    device.queue().wait(device.queue().submit(std::move(commands)));
    bytes = bytes.subspan(part);
    offset += part;
  }
}

}  // namespace vasa::gpu
