#pragma once
#include <vulkan/vulkan.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "gpu/shader.h"
#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// Push constants hold addresses and a few numbers. 128 bytes is what every device grants.
constexpr std::uint32_t kMaxPushBytes = 128;

/// What may be pushed: plain data of whole words that fits.
template <class T>
concept PushConstants = std::is_trivially_copyable_v<T> && sizeof(T) <= kMaxPushBytes && sizeof(T) % 4 == 0;

/// Values for `layout(constant_id = id) const ...`; constants not set keep the shader's default.
class Specialization {
 public:
  Specialization& set(std::uint32_t id, std::uint32_t value);
  Specialization& set(std::uint32_t id, float value) { return set(id, std::bit_cast<std::uint32_t>(value)); }

  VkSpecializationInfo info() const;  ///< points into this object

 private:
  std::vector<VkSpecializationMapEntry> entries_;
  std::vector<std::uint32_t> values_;
};

Unique<VkShaderModule> makeShaderModule(Device& device, const ShaderCode& code);
VkPipelineShaderStageCreateInfo shaderStage(VkShaderStageFlagBits stage, VkShaderModule module,
                                            const VkSpecializationInfo* constants);

Unique<VkDescriptorSetLayout> makeSetLayout(Device& device, const char* name,
                                            std::span<const VkDescriptorSetLayoutBinding> bindings,
                                            VkDescriptorSetLayoutCreateFlags flags = 0);

/// Throws Error if pushBytes is over the device's limit.
Unique<VkPipelineLayout> makePipelineLayout(Device& device, std::string_view name, VkShaderStageFlags stages,
                                            std::uint32_t pushBytes,
                                            std::span<const VkDescriptorSetLayout> sets = {});

/// @param constants  nullptr: all are the shader's defaults
Unique<VkPipeline> makeComputePipeline(Device& device, const ShaderCode& code, VkPipelineLayout layout,
                                       const VkSpecializationInfo* constants, const std::string& name);

}  // namespace vasa::gpu
