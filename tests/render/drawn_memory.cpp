#include "render/drawn_memory.h"

#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <cstring>
#include <map>
#include <mutex>
#include <set>

#include "shared/draw.h"

// Functions of Vulkan that the engine calls find these instead of the loader's, which they call in turn.
namespace {

struct Known {
  std::mutex mutex;
  std::map<VkDeviceMemory, VkDeviceSize> allocated;
  std::map<VkBuffer, VkDeviceMemory> memoryOf;
  std::map<VkDeviceAddress, VkBuffer> bufferAt;
  std::set<VkBuffer> drawn;
};

Known& known() {
  static Known all;
  return all;
}

template <class Function>
Function* loaders(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void note(VkBuffer buffer) {
  const std::lock_guard lock(known().mutex);
  known().drawn.insert(buffer);
}

}  // namespace

#define VASA_LOADERS(name) static const auto real = loaders(&name, #name)

extern "C" {

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                const VkAllocationCallbacks* callbacks,
                                                VkDeviceMemory* memory) {
  VASA_LOADERS(vkAllocateMemory);
  const VkResult result = real(device, info, callbacks, memory);
  const std::lock_guard lock(known().mutex);
  if (result == VK_SUCCESS) known().allocated[*memory] = info->allocationSize;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkBindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                  VkDeviceSize offset) {
  VASA_LOADERS(vkBindBufferMemory);
  {
    const std::lock_guard lock(known().mutex);
    known().memoryOf[buffer] = memory;
  }
  return real(device, buffer, memory, offset);
}

VKAPI_ATTR VkDeviceAddress VKAPI_CALL vkGetBufferDeviceAddress(VkDevice device,
                                                               const VkBufferDeviceAddressInfo* info) {
  VASA_LOADERS(vkGetBufferDeviceAddress);
  const VkDeviceAddress address = real(device, info);
  const std::lock_guard lock(known().mutex);
  known().bufferAt[address] = info->buffer;
  return address;
}

VKAPI_ATTR void VKAPI_CALL vkCmdBindVertexBuffers(VkCommandBuffer commands, std::uint32_t first,
                                                  std::uint32_t count, const VkBuffer* buffers,
                                                  const VkDeviceSize* offsets) {
  VASA_LOADERS(vkCmdBindVertexBuffers);
  for (std::uint32_t i = 0; i < count; ++i) note(buffers[i]);
  real(commands, first, count, buffers, offsets);
}

VKAPI_ATTR void VKAPI_CALL vkCmdBindIndexBuffer(VkCommandBuffer commands, VkBuffer buffer,
                                                VkDeviceSize offset, VkIndexType type) {
  VASA_LOADERS(vkCmdBindIndexBuffer);
  note(buffer);
  real(commands, buffer, offset, type);
}

VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndexedIndirect(VkCommandBuffer commands, VkBuffer buffer,
                                                    VkDeviceSize offset, std::uint32_t count,
                                                    std::uint32_t stride) {
  VASA_LOADERS(vkCmdDrawIndexedIndirect);
  note(buffer);
  real(commands, buffer, offset, count, stride);
}

VKAPI_ATTR void VKAPI_CALL vkCmdPushConstants(VkCommandBuffer commands, VkPipelineLayout layout,
                                              VkShaderStageFlags stages, std::uint32_t offset,
                                              std::uint32_t bytes, const void* values) {
  VASA_LOADERS(vkCmdPushConstants);
  if (stages & VK_SHADER_STAGE_VERTEX_BIT && bytes == sizeof(vasa::shared::DrawPush)) {
    VkDeviceAddress colours;
    std::memcpy(&colours, static_cast<const std::byte*>(values) + offsetof(vasa::shared::DrawPush, colours),
                sizeof colours);
    const std::lock_guard lock(known().mutex);
    if (const auto found = known().bufferAt.find(colours); found != known().bufferAt.end())
      known().drawn.insert(found->second);
  }
  real(commands, layout, stages, offset, bytes, values);
}

}  // extern "C"

namespace vasa::test {

void watchDraws() {
  const std::lock_guard lock(known().mutex);
  known().drawn.clear();
}

DrawnMemory drawnMemory() {
  const std::lock_guard lock(known().mutex);
  DrawnMemory sum;
  for (const VkBuffer buffer : known().drawn)
    sum.bytes += known().allocated[known().memoryOf[buffer]], ++sum.buffers;
  return sum;
}

}  // namespace vasa::test
