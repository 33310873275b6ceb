#include "render/surface_pass.h"

#include <algorithm>
#include <cmath>

#include "shared/sweep.h"
#include "spirv/cut_frag.h"
#include "spirv/opaque_frag.h"
#include "spirv/partial_frag.h"
#include "spirv/skin_frag.h"
#include "spirv/surface_vert.h"
#include "spirv/xray_frag.h"

namespace vasa {
namespace {

// shared::TubeVertex as the fixed-function fetch sees it.
constexpr VkVertexInputAttributeDescription kVertex[] = {
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
    {1, 0, VK_FORMAT_R16G16_SNORM, offsetof(shared::TubeVertex, normal)},
};

constexpr float kXrayVessels = 1.8f;
constexpr std::uint32_t kWholePart = 31;  // item shift: a part is one item

// How much light a surface of the x-ray style gathers.
float xrayLight(MeshRole role) {
  return role == MeshRole::bones ? 0.3f : role == MeshRole::organs ? 0.25f : 0.5f;
}

std::uint32_t shiftAndOpacities(std::uint32_t shift, float first, float second = 1, float third = 1) {
  return shift | packColour({first, second, third, 0}) << 8;
}

// The plane over pixels and depth, as a fragment knows its place.
vec4 cutInPicture(const Camera& camera, const mat4& viewProjection, VkExtent2D size) {
  if (!camera.cut) return {0, 0, 0, 1};
  const glm::dvec4 clip = glm::transpose(glm::inverse(glm::dmat4(viewProjection))) * glm::dvec4(*camera.cut);
  return {2 * clip.x / size.width, 2 * clip.y / size.height, clip.z, clip.w - clip.x - clip.y};
}

void bindVertices(VkCommandBuffer commands, const gpu::Buffer& vertices, VkDeviceSize offset) {
  const VkBuffer buffer = vertices.handle();
  vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
}

void bindMeshes(VkCommandBuffer commands, const MeshSet& meshes) {
  bindVertices(commands, meshes.posed(), 0);
  vkCmdBindIndexBuffer(commands, meshes.indices().handle(), 0, VK_INDEX_TYPE_UINT32);
}

void drawPart(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
              const MeshSet::Level& level, std::uint32_t part, const gpu::GraphicsPipeline& pipeline) {
  push.hiddenKinds = 0;
  push.colours = meshes.colours() + 4 * part;
  pipeline.bind(commands, push);
  vkCmdDrawIndexed(commands, level.indexCount, 1, level.firstIndex, std::int32_t(level.firstVertex), 0);
}

// The parts of a role that are shown, until the next call.
std::span<std::uint32_t> partsOf(const MeshSet& meshes, std::span<const MeshSet::Level> levels,
                                 MeshRole role) {
  static thread_local std::vector<std::uint32_t> parts;  // kept, so that a frame allocates nothing
  parts.clear();
  for (std::uint32_t i = 0; i < meshes.parts().size(); ++i)
    if (levels[i].indexCount > 0 && meshes.parts()[i].role == role) parts.push_back(i);
  return parts;
}

}  // namespace

std::uint32_t hiddenKinds(const Look& look) {
  const auto bit = [](VesselKind kind) { return 1u << std::uint32_t(kind); };
  std::uint32_t hidden = 1u << kHiddenKind;
  if (!look.drawArteries || look.arteryOpacity <= 0) hidden |= bit(VesselKind::artery);
  if (!look.drawVeins || look.veinOpacity <= 0) hidden |= bit(VesselKind::vein) | bit(VesselKind::portalVein);
  if (!look.drawOtherVessels) hidden |= bit(VesselKind::lymphatic) | bit(VesselKind::other);
  return hidden;
}

shared::DrawPush drawConstants(const Camera& camera, const Look& look, VkExtent2D size) {
  const float width = float(size.width), height = float(size.height);
  const mat3 axes = cameraAxes(camera);
  shared::DrawPush push{};
  push.viewProjection = viewProjection(camera, width / height);
  const quat turn = glm::quat_cast(glm::transpose(axes));
  push.turn = {turn.x, turn.y, turn.z, turn.w};
  push.cut = cutInPicture(camera, push.viewProjection, size);
  push.hiddenKinds = hiddenKinds(look);
  if (camera.orthographicHeight <= 0) {
    const float slope = std::tan(camera.verticalAngle / 2);
    push.eyeCorner = {slope * width / height, -slope};
    push.eyeStep = 2 * slope / height;
  }
  return push;
}

VesselDraws drawsOf(const Template& filled) {
  return {filled.pool, filled.pool, filled.colours, filled.draws,
          std::uint32_t(filled.draws.bytes() / sizeof(shared::DrawCommand))};
}

VesselDraws drawsOf(const PatchSet& patches) {
  const PatchDraws& draws = patches.draws();
  return {draws.vertices, draws.indices, draws.colours, draws.draws, patches.groups()};
}

bool isPartial(const Camera& camera, const Look& look) { return camera.cut || anyTranslucent(look); }

SurfacePass::SurfacePass(gpu::Device& device, const gpu::TargetSpec& target)
    : device_(&device), target_(target) {}

const SurfacePass::Pipelines& SurfacePass::pipelines(const Look& look, bool partial) const {
  std::optional<Pipelines>& made = made_[std::size_t(look.style)][partial];
  if (!made) made.emplace(make(look.style, partial));
  return *made;
}

SurfacePass::Pipelines SurfacePass::make(LookStyle style, bool partial) const {
  Pipelines made;
  gpu::GraphicsSpec common{
      .vertex = spirv::surface_vert,
      .fragment = partial ? gpu::ShaderCode(spirv::partial_frag) : gpu::ShaderCode(spirv::opaque_frag),
      .pushBytes = sizeof(shared::DrawPush),
      .vertexBytes = sizeof(shared::TubeVertex),
      .attributes = kVertex,
      .colour = target_.colour,
      .depth = target_.depth,
      .samples = target_.samples,
      .depthTest = VK_COMPARE_OP_GREATER,
  };
  common.constants.set(1, partial ? std::uint32_t(target_.samples) : 0u);
  gpu::GraphicsSpec spec = common;
  if (style == LookStyle::xray) {
    spec.name = "x-ray";
    spec.fragment = spirv::xray_frag;
    spec.depthTest = VK_COMPARE_OP_ALWAYS;
    spec.depthWrite = false;
    spec.blend = gpu::Blend::add;
    for (auto* pipeline : {&made.tubes, &made.opaque, &made.closed, &made.skinColour})
      *pipeline = gpu::GraphicsPipeline(*device_, spec);
    return made;
  }
  spec.constants.set(0, std::uint32_t(style));
  spec.name = "tubes";
  if (partial) spec.cull = VK_CULL_MODE_NONE;  // cut open
  made.tubes = gpu::GraphicsPipeline(*device_, spec);
  spec.name = "opaque meshes";
  spec.cull = VK_CULL_MODE_BACK_BIT;
  made.closed = gpu::GraphicsPipeline(*device_, spec);
  spec.cull = VK_CULL_MODE_NONE;  // bones of scanned bodies have holes
  made.opaque = gpu::GraphicsPipeline(*device_, spec);
  spec.name = "skin";
  spec.cull = VK_CULL_MODE_BACK_BIT;
  spec.fragment = spirv::skin_frag;
  spec.depthTest = VK_COMPARE_OP_EQUAL;
  spec.depthWrite = false;
  spec.blend = gpu::Blend::premultiplied;
  made.skinColour = gpu::GraphicsPipeline(*device_, spec);
  spec = common;
  spec.name = "skin depth";
  spec.fragment = partial ? gpu::ShaderCode(spirv::cut_frag) : gpu::ShaderCode{};
  spec.colourWrite = false;
  made.skinDepth = gpu::GraphicsPipeline(*device_, spec);
  return made;
}

void SurfacePass::recordVessels(VkCommandBuffer commands, shared::DrawPush push, const VesselDraws& draws,
                                const Look& look, bool partial) const {
  push.colours = draws.colours.address();
  push.shiftAndOpacities = shiftAndOpacities(shared::kBlockShift, look.arteryOpacity, look.veinOpacity);
  push.opacity = kXrayVessels;
  pipelines(look, partial).tubes.bind(commands, push);
  bindVertices(commands, draws.vertices, 0);
  vkCmdBindIndexBuffer(commands, draws.indices.handle(), 0, VK_INDEX_TYPE_UINT32);
  // One by one: Vulkan 1.3 does not promise multiDrawIndirect, and a frame has few groups.
  for (std::uint32_t i = 0; i < draws.count; ++i)
    vkCmdDrawIndexedIndirect(commands, draws.draws.handle(), i * sizeof(shared::DrawCommand), 1,
                             sizeof(shared::DrawCommand));
}

void SurfacePass::recordOpaque(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                               std::span<const MeshSet::Level> levels, const Look& look, bool partial) const {
  const Pipelines& own = pipelines(look, partial);
  bindMeshes(commands, meshes);
  for (const MeshRole role : {MeshRole::bones, MeshRole::heart, MeshRole::other}) {
    push.opacity = xrayLight(role);
    push.shiftAndOpacities = shiftAndOpacities(kWholePart, opacityOf(role, look));
    for (const std::uint32_t i : partsOf(meshes, levels, role))
      drawPart(commands, push, meshes, levels[i], i, levels[i].bothSides ? own.opaque : own.closed);
  }
}

void SurfacePass::recordTranslucent(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                                    std::span<const MeshSet::Level> levels, MeshRole role, const Look& look,
                                    bool partial) const {
  const Pipelines& own = pipelines(look, partial);
  const bool xray = look.style == LookStyle::xray;
  push.shiftAndOpacities = shiftAndOpacities(kWholePart, 1);
  bindMeshes(commands, meshes);
  const std::span<std::uint32_t> parts = partsOf(meshes, levels, role);
  std::ranges::sort(parts, [&](std::uint32_t a, std::uint32_t b) {  // from far to near
    return levels[a].depth != levels[b].depth ? levels[a].depth > levels[b].depth : a < b;
  });
  for (const std::uint32_t i : parts) {
    const float ofPart = role == MeshRole::skin ? 1 : meshes.parts()[i].opacity;
    push.opacity = ofPart * opacityOf(role, look) * (xray ? xrayLight(role) : 1);
    if (!xray) drawPart(commands, push, meshes, levels[i], i, own.skinDepth);
    drawPart(commands, push, meshes, levels[i], i, own.skinColour);
  }
}

}  // namespace vasa
