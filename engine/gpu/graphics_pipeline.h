#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>

#include "gpu/pipeline.h"

namespace vasa::gpu {

enum class Blend {
  none,
  premultiplied,  ///< colour + (1 - alpha) * what is there
  add,            ///< colour + what is there
  multiply,       ///< colour * what is there
};

struct GraphicsSpec {
  const char* name = "graphics";
  ShaderCode vertex;
  ShaderCode fragment;          ///< without words: only depth is written
  std::uint32_t pushBytes = 0;  ///< one block that both stages see
  Specialization constants;     ///< for both stages
  std::span<const VkDescriptorSetLayout> sets;
  std::uint32_t vertexBytes = 0;  ///< of one vertex
  /// Of a vertex; none: the vertex shader fetches vertices by address and gl_VertexIndex.
  std::span<const VkVertexInputAttributeDescription> attributes;

  VkFormat colour = VK_FORMAT_R8G8B8A8_SRGB;
  VkFormat depth = VK_FORMAT_D32_SFLOAT;  ///< VK_FORMAT_UNDEFINED: none
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;

  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPolygonMode polygons = VK_POLYGON_MODE_FILL;
  VkCullModeFlags cull = VK_CULL_MODE_BACK_BIT;
  VkFrontFace front = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  VkCompareOp depthTest = VK_COMPARE_OP_LESS;  ///< VK_COMPARE_OP_ALWAYS: no test
  bool depthWrite = true;
  bool colourWrite = true;  ///< false: of a fragment shader that only discards
  Blend blend = Blend::none;
};

/// Vertex and fragment shader for dynamic rendering; viewport and scissor are set while recording
/// (Target::begin() does). Y points down in Vulkan's clip space: a projection that flips y turns
/// counter-clockwise fronts of a right-handed, +Y up scene into counter-clockwise ones here.
class GraphicsPipeline {
 public:
  GraphicsPipeline() = default;
  GraphicsPipeline(Device& device, const GraphicsSpec& spec);

  VkPipeline handle() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }

  /// Binds and pushes; then vkCmdDraw and its kin.
  template <PushConstants Push>
  void bind(VkCommandBuffer commands, const Push& push) const {
    bindBytes(commands, &push, sizeof push);
  }

 private:
  void bindBytes(VkCommandBuffer commands, const void* push, std::uint32_t bytes) const;

  [[maybe_unused]] std::uint32_t pushBytes_ = 0;  // read by an assertion alone
  Unique<VkPipelineLayout> layout_;
  Unique<VkPipeline> pipeline_;
};

}  // namespace vasa::gpu
