#pragma once
#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <string>

#include "gpu/address_shadow.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace vasa::gpu {

struct ComputeSpec {
  ShaderCode shader;
  std::uint32_t pushBytes = 0;
  Specialization constants;
  std::span<const VkDescriptorSetLayout> sets;
};

/// Workgroups of `size` that cover `count` items.
constexpr std::uint32_t groupsFor(std::uint32_t count, std::uint32_t size) {
  return count / size + (count % size != 0);
}

/// A compute shader, ready to run.
class ComputePipeline {
 public:
  ComputePipeline() = default;
  ComputePipeline(Device& device, const ComputeSpec& spec);

  VkPipeline handle() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }

  /// Binds, pushes and dispatches. No group in a direction: records nothing.
  /// Throws Error if there are more groups than the device takes (65,535 in each direction is granted).
  template <PushConstants Push>
  void dispatch(VkCommandBuffer commands, const Push& push, std::uint32_t x, std::uint32_t y = 1,
                std::uint32_t z = 1) const {
    if (!worthDispatching({x, y, z})) return;
    bind(commands, &push, sizeof push);
    vkCmdDispatch(commands, x, y, z);
  }
  /// The same with a VkDispatchIndirectCommand that the device finds at `offset` in `arguments`.
  template <PushConstants Push>
  void dispatchIndirect(VkCommandBuffer commands, const Push& push, const Buffer& arguments,
                        VkDeviceSize offset = 0) const {
    bind(commands, &push, sizeof push);
    vkCmdDispatchIndirect(commands, arguments.handle(), offset);
  }

 private:
  void bind(VkCommandBuffer commands, const void* push, std::uint32_t bytes) const;
  bool worthDispatching(std::array<std::uint32_t, 3> groups) const;

  std::string name_;
  [[maybe_unused]] std::uint32_t pushBytes_ = 0;  // read by an assertion alone
  std::array<std::uint32_t, 3> mostGroups_{};
  AddressShadow shadow_;
  Unique<VkPipelineLayout> layout_;
  Unique<VkPipeline> pipeline_;
};

}  // namespace vasa::gpu
