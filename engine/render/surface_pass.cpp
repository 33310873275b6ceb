#include "render/surface_pass.h"

#include <array>
#include <cmath>

#include "shared/sweep.h"
#include "spirv/opaque_frag.h"
#include "spirv/skin_frag.h"
#include "spirv/surface_vert.h"
#include "spirv/xray_frag.h"

namespace vasa {
namespace {

// shared::TubeVertex as the fixed-function fetch sees it.
struct VertexLayout {
  VkVertexInputBindingDescription binding{0, sizeof(shared::TubeVertex), VK_VERTEX_INPUT_RATE_VERTEX};
  std::array<VkVertexInputAttributeDescription, 2> attributes{{
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
      {1, 0, VK_FORMAT_R16G16_SNORM, offsetof(shared::TubeVertex, normal)},
  }};
  VkPipelineVertexInputStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                                            nullptr,
                                            0,
                                            1,
                                            &binding,
                                            std::uint32_t(attributes.size()),
                                            attributes.data()};
};

constexpr float kXrayVessels = 1.8f;
constexpr float kOrganOpacity = 0.3f;

// How much light a surface of the x-ray style gathers.
float xrayLight(MeshRole role) {
  switch (role) {
    case MeshRole::bones: return 0.3f;
    case MeshRole::heart: return 0.5f;
    case MeshRole::skin: return 0.5f;
    case MeshRole::organs: return 0.25f;
    case MeshRole::other: break;
  }
  return 0.5f;
}

void bindVertices(VkCommandBuffer commands, const gpu::Buffer& vertices, VkDeviceSize offset) {
  const VkBuffer buffer = vertices.handle();
  vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
}

// @param closed  pipeline for parts whose triangles' backs are not seen
void drawParts(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
               std::span<const MeshSet::Level> levels, const gpu::GraphicsPipeline& pipeline,
               const gpu::GraphicsPipeline& closed, MeshRole role) {
  bindVertices(commands, meshes.posed(), 0);
  vkCmdBindIndexBuffer(commands, meshes.indices().handle(), 0, VK_INDEX_TYPE_UINT32);
  push.colours = meshes.colours();
  push.itemShift = 31;  // a part is one item
  push.hiddenKinds = 0;
  for (std::uint32_t i = 0; i < meshes.parts().size(); ++i) {
    const MeshSet::Level& level = levels[i];
    if (level.indexCount == 0 || meshes.parts()[i].role != role) continue;
    push.firstItem = i;
    (level.bothSides ? pipeline : closed).bind(commands, push);
    vkCmdDrawIndexed(commands, level.indexCount, 1, level.firstIndex, std::int32_t(level.firstVertex), 0);
  }
}

}  // namespace

std::uint32_t hiddenKinds(const Look& look) {
  const auto bit = [](VesselKind kind) { return 1u << std::uint32_t(kind); };
  std::uint32_t hidden = 1u << kHiddenKind;
  if (!look.drawArteries) hidden |= bit(VesselKind::artery);
  if (!look.drawVeins) hidden |= bit(VesselKind::vein) | bit(VesselKind::portalVein);
  if (!look.drawOtherVessels) hidden |= bit(VesselKind::lymphatic) | bit(VesselKind::other);
  return hidden;
}

shared::DrawPush drawConstants(const Camera& camera, const Look& look, VkExtent2D size) {
  const float width = float(size.width), height = float(size.height);
  const mat3 axes = cameraAxes(camera);
  shared::DrawPush push{};
  push.viewProjection = viewProjection(camera, width / height);
  push.right = axes[0];
  push.up = axes[1];
  push.hiddenKinds = hiddenKinds(look);
  if (camera.orthographicHeight <= 0) {
    const float slope = std::tan(camera.verticalAngle / 2);
    push.eyeCorner = {slope * width / height, -slope};
    push.eyeStep = {-2 * slope / height, 2 * slope / height};
  }
  return push;
}

SurfacePass::SurfacePass(gpu::Device& device, const gpu::TargetSpec& target) {
  const VertexLayout layout;
  const gpu::GraphicsSpec common{
      .vertex = spirv::surface_vert,
      .fragment = spirv::opaque_frag,
      .pushBytes = sizeof(shared::DrawPush),
      .vertexInput = &layout.info,
      .colour = target.colour,
      .depth = target.depth,
      .samples = target.samples,
      .depthTest = VK_COMPARE_OP_GREATER,
  };
  for (const LookStyle style : {LookStyle::atlas, LookStyle::clinical}) {
    const std::size_t i = std::size_t(style);
    gpu::GraphicsSpec spec = common;
    spec.constants.set(0, std::uint32_t(style));
    spec.name = "tubes";
    tubes_[i] = gpu::GraphicsPipeline(device, spec);
    spec.name = "opaque meshes";
    closed_[i] = gpu::GraphicsPipeline(device, spec);
    spec.cull = VK_CULL_MODE_NONE;  // bones of scanned bodies have holes
    opaque_[i] = gpu::GraphicsPipeline(device, spec);
    spec.name = "skin";
    spec.cull = VK_CULL_MODE_BACK_BIT;
    spec.fragment = spirv::skin_frag;
    spec.depthTest = VK_COMPARE_OP_EQUAL;
    spec.depthWrite = false;
    spec.blend = gpu::Blend::premultiplied;
    skinColour_[i] = gpu::GraphicsPipeline(device, spec);
  }
  gpu::GraphicsSpec spec = common;
  spec.name = "skin depth";
  spec.fragment = {};
  skinDepth_ = gpu::GraphicsPipeline(device, spec);
  spec.name = "x-ray";
  spec.fragment = spirv::xray_frag;
  spec.depthTest = VK_COMPARE_OP_ALWAYS;
  spec.depthWrite = false;
  spec.blend = gpu::Blend::add;
  for (auto* pipelines : {&tubes_, &opaque_, &closed_, &skinColour_})
    (*pipelines)[std::size_t(LookStyle::xray)] = gpu::GraphicsPipeline(device, spec);
}

void SurfacePass::recordVessels(VkCommandBuffer commands, shared::DrawPush push, const TubeDraws& draws,
                                std::uint32_t groups, LookStyle style) const {
  push.colours = draws.colours.address();
  push.firstItem = 0;
  push.itemShift = shared::kBlockShift;
  push.opacity = kXrayVessels;
  tubes_[std::size_t(style)].bind(commands, push);
  bindVertices(commands, draws.vertices, 0);
  vkCmdBindIndexBuffer(commands, draws.indices.handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexedIndirect(commands, draws.draws.handle(), 0, groups, sizeof(shared::DrawCommand));
}

void SurfacePass::recordOpaque(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                               std::span<const MeshSet::Level> levels, const Look& look) const {
  for (const MeshRole role : {MeshRole::bones, MeshRole::heart, MeshRole::other}) {
    push.opacity = xrayLight(role);
    drawParts(commands, push, meshes, levels, opaque_[std::size_t(look.style)], closed_[std::size_t(look.style)], role);
  }
}

void SurfacePass::recordTranslucent(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                             std::span<const MeshSet::Level> levels, const Look& look) const {
  const bool xray = look.style == LookStyle::xray;
  const gpu::GraphicsPipeline& colour = skinColour_[std::size_t(look.style)];
  for (const MeshRole role : {MeshRole::organs, MeshRole::skin}) {
    push.opacity = (role == MeshRole::skin ? look.skinOpacity : kOrganOpacity) * (xray ? xrayLight(role) : 1);
    if (!xray) drawParts(commands, push, meshes, levels, skinDepth_, skinDepth_, role);
    drawParts(commands, push, meshes, levels, colour, colour, role);
  }
}

}  // namespace vasa
