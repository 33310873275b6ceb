#pragma once
#include <vulkan/vulkan.h>

#include <cstddef>
#include <vector>

#include "gpu/address_map.h"
#include "gpu/pushed_addresses.h"
#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// Makes synchronization validation see what a compute shader reaches by address.
///
/// The validation layer follows descriptors, copies, vertex, index and indirect buffers and attachments, but
/// no buffer addresses: a missing barrier between two passes of this engine would go unseen. So for each
/// dispatch a shadow of it is recorded, too: for each pushed address, a dispatch of no workgroups whose only
/// descriptor is the first 16 bytes at that address, read or written as the shader declares its block. It
/// does nothing on the device, and the layer checks it like any other access.
///
/// Seen: passes that use the same address, and a pass against any copy, vertex fetch, index fetch or indirect
/// argument that covers it. Not seen: addresses within buffers, different addresses whose ranges overlap, and
/// reads by address of vertex and fragment shaders. Two dispatches that write disjoint parts through one
/// address are reported: give each part its own address.
class AddressShadow {
 public:
  AddressShadow() = default;
  /// Stays empty unless the device checks synchronization.
  AddressShadow(Device& device, const ShaderCode& shader);

  /// Before the real dispatch is bound.
  void record(VkCommandBuffer commands, const std::byte* push) const;

 private:
  void touch(VkCommandBuffer commands, const AddressMap::Place& place, bool write) const;
  void orderOwnShadows(VkCommandBuffer commands, const AddressMap::Place& place) const;

  Device* device_ = nullptr;  // nullptr: empty
  std::vector<PushedAddress> addresses_;
  Unique<VkDescriptorSetLayout> set_;
  Unique<VkPipelineLayout> layout_;
  Unique<VkPipeline> read_, write_;
};

}  // namespace vasa::gpu
