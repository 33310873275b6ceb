#include "gpu/pipeline.h"

#include <string>

#include "gpu/make.h"

namespace vasa::gpu {

Specialization& Specialization::set(std::uint32_t id, std::uint32_t value) {
  entries_.push_back({id, std::uint32_t(values_.size() * sizeof value), sizeof value});
  values_.push_back(value);
  return *this;
}

VkSpecializationInfo Specialization::info() const {
  return {std::uint32_t(entries_.size()), entries_.data(), values_.size() * sizeof(std::uint32_t),
          values_.data()};
}

Unique<VkShaderModule> makeShaderModule(Device& device, const ShaderCode& code) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  const auto words =
      device.features().core.features.shaderInt64 && !code.int64Words.empty() ? code.int64Words : code.words;
  info.codeSize = words.size_bytes();
  info.pCode = words.data();
  const std::string call = "vkCreateShaderModule of " + std::string(code.name);
  return make(device, vkCreateShaderModule, call.c_str(), info, code.name);
}

VkPipelineShaderStageCreateInfo shaderStage(VkShaderStageFlagBits stage, VkShaderModule module,
                                            const VkSpecializationInfo* constants) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = module;
  info.pName = "main";
  info.pSpecializationInfo = constants;
  return info;
}

Unique<VkDescriptorSetLayout> makeSetLayout(Device& device, const char* name,
                                            std::span<const VkDescriptorSetLayoutBinding> bindings,
                                            VkDescriptorSetLayoutCreateFlags flags) {
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.flags = flags;
  info.bindingCount = std::uint32_t(bindings.size());
  info.pBindings = bindings.data();
  return make(device, vkCreateDescriptorSetLayout, "vkCreateDescriptorSetLayout", info, name);
}

Unique<VkPipelineLayout> makePipelineLayout(Device& device, std::string_view name, VkShaderStageFlags stages,
                                            std::uint32_t pushBytes,
                                            std::span<const VkDescriptorSetLayout> sets) {
  const std::uint32_t most = device.limits().maxPushConstantsSize;
  if (pushBytes > most)
    throw Error({Fault::failed, std::string(name) + ": " + std::to_string(pushBytes) +
                                    " bytes of push constants, more than the " + std::to_string(most) +
                                    " of the device; put them into a buffer and push its address"});
  const VkPushConstantRange range{stages, 0, pushBytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = std::uint32_t(sets.size());
  info.pSetLayouts = sets.data();
  info.pushConstantRangeCount = pushBytes ? 1 : 0;
  info.pPushConstantRanges = &range;
  return make(device, vkCreatePipelineLayout, "vkCreatePipelineLayout", info, name);
}

Unique<VkPipeline> makeComputePipeline(Device& device, const ShaderCode& code, VkPipelineLayout layout,
                                       const VkSpecializationInfo* constants, const std::string& name) {
  const Unique<VkShaderModule> module = makeShaderModule(device, code);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = shaderStage(VK_SHADER_STAGE_COMPUTE_BIT, module.get(), constants);
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const std::string call = "vkCreateComputePipelines of " + name;
  check(vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline),
        call.c_str());
  device.setName(pipeline, name);
  return {device.handle(), pipeline};
}

}  // namespace vasa::gpu
