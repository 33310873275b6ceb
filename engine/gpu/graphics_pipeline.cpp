#include "gpu/graphics_pipeline.h"

#include <array>
#include <cassert>
#include <string>

#include "gpu/device.h"
#include "gpu/error.h"

namespace vasa::gpu {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkPipelineColorBlendAttachmentState blendOf(Blend blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                         VK_COLOR_COMPONENT_A_BIT;
  state.blendEnable = blend != Blend::none;
  state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  if (blend == Blend::add) state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  if (blend == Blend::multiply) {
    state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_SRC_COLOR;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  }
  state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

VkPipelineRasterizationStateCreateInfo rasterOf(const GraphicsSpec& spec) {
  VkPipelineRasterizationStateCreateInfo state{};
  state.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  state.polygonMode = spec.polygons;
  state.cullMode = spec.cull;
  state.frontFace = spec.front;
  state.lineWidth = 1.0f;
  return state;
}

VkPipelineDepthStencilStateCreateInfo depthOf(const GraphicsSpec& spec) {
  VkPipelineDepthStencilStateCreateInfo state{};
  state.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  const bool present = spec.depth != VK_FORMAT_UNDEFINED;
  // A write needs the test to be on, and ALWAYS lets everything pass.
  state.depthTestEnable = present && (spec.depthWrite || spec.depthTest != VK_COMPARE_OP_ALWAYS);
  state.depthWriteEnable = present && spec.depthWrite;
  state.depthCompareOp = spec.depthTest;
  return state;
}

// The parts that every pipeline of the engine has alike.
struct FixedState {
  std::array<VkDynamicState, 2> dynamicStates{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, nullptr, 0,
                                           std::uint32_t(dynamicStates.size()), dynamicStates.data()};
  VkPipelineViewportStateCreateInfo viewport{
      VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, nullptr, 0, 1, nullptr, 1, nullptr};
};

}  // namespace

GraphicsPipeline::GraphicsPipeline(Device& device, const GraphicsSpec& spec) : pushBytes_(spec.pushBytes) {
  layout_ = makePipelineLayout(device, spec.name, kStages, spec.pushBytes, spec.sets);
  const Unique<VkShaderModule> vertex = makeShaderModule(device, spec.vertex);
  const bool shaded = !spec.fragment.words.empty();
  const Unique<VkShaderModule> fragment =
      shaded ? makeShaderModule(device, spec.fragment) : Unique<VkShaderModule>();
  const VkSpecializationInfo constants = spec.constants.info();
  const std::array stages{shaderStage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get(), &constants),
                          shaderStage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get(), &constants)};
  const FixedState fixed;
  const VkVertexInputBindingDescription binding{0, spec.vertexBytes, VK_VERTEX_INPUT_RATE_VERTEX};
  VkPipelineVertexInputStateCreateInfo vertices{};
  vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertices.vertexBindingDescriptionCount = spec.attributes.empty() ? 0 : 1;
  vertices.pVertexBindingDescriptions = &binding;
  vertices.vertexAttributeDescriptionCount = std::uint32_t(spec.attributes.size());
  vertices.pVertexAttributeDescriptions = spec.attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = spec.topology;
  const VkPipelineRasterizationStateCreateInfo raster = rasterOf(spec);
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = spec.samples;
  const VkPipelineDepthStencilStateCreateInfo depth = depthOf(spec);
  VkPipelineColorBlendAttachmentState attachment = blendOf(spec.blend);
  if (!shaded || !spec.colourWrite) attachment.colorWriteMask = 0;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 1;
  blend.pAttachments = &attachment;
  VkPipelineRenderingCreateInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &spec.colour;
  rendering.depthAttachmentFormat = spec.depth;

  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &rendering;
  info.stageCount = shaded ? 2 : 1;
  info.pStages = stages.data();
  info.pVertexInputState = &vertices;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &fixed.viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &fixed.dynamic;
  info.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  const std::string call = std::string("vkCreateGraphicsPipelines of ") + spec.name;
  check(vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline),
        call.c_str());
  pipeline_ = {device.handle(), pipeline};
  device.setName(pipeline, spec.name);
}

void GraphicsPipeline::bindBytes(VkCommandBuffer commands, const void* push, std::uint32_t bytes) const {
  assert(bytes == pushBytes_);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, handle());
  vkCmdPushConstants(commands, layout(), kStages, 0, bytes, push);
}

}  // namespace vasa::gpu
