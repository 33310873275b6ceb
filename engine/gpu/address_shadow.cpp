#include "gpu/address_shadow.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "spirv/access_read_comp.h"
#include "spirv/access_write_comp.h"

namespace vasa::gpu {
namespace {

constexpr VkDeviceSize kTouched = 16;
constexpr VkDescriptorSetLayoutBinding kBinding{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                                                VK_SHADER_STAGE_COMPUTE_BIT, nullptr};

}  // namespace

AddressShadow::AddressShadow(Device& device, const ShaderCode& shader) {
  if (!device.addresses()) return;
  addresses_ = pushedAddresses(shader);
  if (addresses_.empty()) return;
  device_ = &device;
  const std::string name(shader.name);
  set_ = makeSetLayout(device, "access by address", {&kBinding, 1},
                       VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR);
  layout_ = makePipelineLayout(device, name, VK_SHADER_STAGE_COMPUTE_BIT, 0, {&set_.get(), 1});
  read_ = makeComputePipeline(device, spirv::access_read_comp, layout_.get(), nullptr,
                              name + " reads by address");
  write_ = makeComputePipeline(device, spirv::access_write_comp, layout_.get(), nullptr,
                               name + " writes by address");
}

void AddressShadow::record(VkCommandBuffer commands, const std::byte* push) const {
  if (!device_) return;
  // The shadows are commands of their own, so one that is read and written through two blocks would be a
  // hazard against itself: one access a place, and a write outweighs.
  std::map<VkDeviceAddress, bool> accesses;
  for (const PushedAddress& pushed : addresses_) {
    VkDeviceAddress address;
    std::memcpy(&address, push + pushed.offset, sizeof address);
    accesses[address] |= pushed.written;
  }
  for (const auto& [address, written] : accesses) {
    const auto place = device_->addresses()->find(address);
    if (!place) continue;
    const bool writtenBefore = device_->addresses()->wroteBefore(address, written);
    if (written && writtenBefore) {
      touch(commands, *place, false);
      orderOwnShadows(commands, *place);
    }
    touch(commands, *place, written);
  }
}

// The layer (1.3.239) does not report a write after a write through descriptors of one stage. After a write,
// a shadow therefore reads first, which is reported if no barrier came between.
void AddressShadow::orderOwnShadows(VkCommandBuffer commands, const AddressMap::Place& place) const {
  VkBufferMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.buffer = place.buffer;
  barrier.offset = place.offset;
  barrier.size = std::min(kTouched, place.bytes - place.offset);
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.bufferMemoryBarrierCount = 1;
  dependency.pBufferMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void AddressShadow::touch(VkCommandBuffer commands, const AddressMap::Place& place, bool write) const {
  const VkDeviceSize offset = place.offset - place.offset % device_->limits().minStorageBufferOffsetAlignment;
  const VkDescriptorBufferInfo buffer{place.buffer, offset,
                                      std::min(place.offset - offset + kTouched, place.bytes - offset)};
  VkWriteDescriptorSet descriptor{};
  descriptor.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  descriptor.descriptorCount = 1;
  descriptor.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  descriptor.pBufferInfo = &buffer;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, write ? write_.get() : read_.get());
  device_->pushDescriptor(commands, layout_.get(), descriptor);
  vkCmdDispatch(commands, 0, 0, 0);
}

}  // namespace vasa::gpu
