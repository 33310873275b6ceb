#include "render/capillary_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "gpu/barrier.h"
#include "gpu/transfer.h"
#include "growth/ribbon.h"
#include "spirv/capillary_comp.h"
#include "spirv/capillary_frag.h"
#include "spirv/capillary_vert.h"

namespace vasa {
namespace {

constexpr std::array<std::uint32_t, 5> kEdges{shared::kThreads, 3, 5, 8, shared::kMostCapillaryEdges};
constexpr vec4 kBedColour{0.62f, 0.15f, 0.36f, 1};

std::size_t edgesIndex(std::uint32_t edges) {
  const auto found = std::find(kEdges.begin(), kEdges.end(), edges);
  assert(found != kEdges.end());
  return std::size_t(found - kEdges.begin());
}

constexpr VkVertexInputAttributeDescription kRibbonVertex[] = {
    {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
    {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(shared::CapillaryVertex, colour)},
    {2, 0, VK_FORMAT_R16G16_SNORM, offsetof(shared::CapillaryVertex, across)},
};

gpu::Buffer ringBuffer(gpu::Device& device) {
  return {device,
          {.name = "capillary ring",
           .bytes = VkDeviceSize(shared::kRingCurves) * 2 * (shared::kMostCapillaryEdges + 1) *
                    sizeof(shared::CapillaryVertex),
           .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}};
}

}  // namespace

shared::GrowthView growthView(const Camera& camera, VkExtent2D size, std::uint32_t seed) {
  const float width = float(size.width), height = float(size.height);
  const bool perspective = camera.orthographicHeight <= 0;
  const mat3 axes = cameraAxes(camera);
  shared::GrowthView view{};
  view.viewProjection = viewProjection(camera, width / height);
  view.eye = perspective ? camera.position : axes[2];
  view.perspective = perspective ? 1.0f : 0.0f;
  view.depth = perspective ? vec4(-axes[2], glm::dot(axes[2], camera.position)) : vec4(0, 0, 0, 1);
  view.right = axes[0];
  view.up = axes[1];
  view.focal =
      perspective ? height / (2 * std::tan(camera.verticalAngle / 2)) : height / camera.orthographicHeight;
  view.seed = seed;
  view.capillary = packColour(kBedColour);
  return view;
}

CapillaryPass::CapillaryPass(gpu::Device& device, const gpu::TargetSpec& target, const TubeSet& tubes,
                             const GrowthRules& rules, const CapillaryBeds& beds, const CapillaryWish& wish)
    : device_(&device), target_(target), tubes_(tubes), beds_(beds), rules_(rules), wish_(wish) {
  assert(beds.spans.size() == tubes.table().spanCount);
  if (wish.levels == 0) return;
  grow_ = gpu::ComputePipeline(device, {spirv::capillary_comp, sizeof(shared::CapillaryPush)});
  for (gpu::Buffer& ring : rings_) ring = ringBuffer(device);
  for (std::size_t i = 0; i < kEdges.size(); ++i) {
    const auto indices = ribbonIndices(kEdges[i], shared::kRingCurves);
    indices_[i] = gpu::makeBuffer(device, "capillary indices", std::span<const std::uint32_t>(indices));
  }
  tables_ = gpu::makeBuffer(device, "growth tables", std::span(&rules.tables, 1));
  bedBuffer_ = gpu::makeBuffer(device, "growth beds", std::span<const shared::GrowthBed>(beds.beds));
  spans_ = gpu::makeBuffer(device, "growth spans", std::span<const shared::SweepRecord>(beds.spans));
  colours_ = gpu::Buffer(device, {"growth colours", 4 * VkDeviceSize(beds.spans.size())});
  const VkDeviceSize frameBytes = sizeof(shared::GrowthView) + mostJobs(beds) * sizeof(shared::GrowthJob);
  host_ = gpu::Buffer(device, {"capillary frame, host", frameBytes, gpu::MemoryRole::upload});
  frame_ = gpu::Buffer(device, {"capillary frame", frameBytes});
}

// Most runs need one of the six.
const gpu::GraphicsPipeline& CapillaryPass::pipelineFor(LookStyle style, bool partial) const {
  auto& made = draw_[std::size_t(style)][partial];
  if (made) return *made;
  gpu::GraphicsSpec spec{.name = "capillaries",
                         .vertex = spirv::capillary_vert,
                         .fragment = spirv::capillary_frag,
                         .pushBytes = sizeof(shared::DrawPush),
                         .vertexBytes = sizeof(shared::CapillaryVertex),
                         .attributes = kRibbonVertex,
                         .colour = target_.colour,
                         .depth = target_.depth,
                         .samples = target_.samples,
                         .cull = VK_CULL_MODE_NONE,
                         .depthTest = VK_COMPARE_OP_GREATER,
                         .blend = gpu::Blend::premultiplied};
  spec.constants.set(0, std::uint32_t(style));
  if (partial) spec.constants.set(1, std::uint32_t(target_.samples));
  // Curves hide little where they are thinner than a pixel or deep under the skin, and their fading edges
  // less than that: they lie over one another, the farthest beds first, and hide nothing that comes after
  // them.
  spec.depthWrite = false;
  if (style == LookStyle::xray) {
    spec.depthTest = VK_COMPARE_OP_ALWAYS;
    spec.blend = gpu::Blend::add;
  }
  return made.emplace(*device_, spec);
}

void CapillaryPass::setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours) {
  assert(spanColours.size() == beds_.spans.size());
  if (colours_.bytes() > 0) gpu::uploadBytes(device, colours_, std::as_bytes(spanColours));
}

void CapillaryPass::prepare(std::span<const vec4> points, std::span<const quat> knots,
                            const shared::GrowthView& view) {
  planCapillaries({{tubes_.table(), points, knots}, rules_.tables, beds_, view}, wish_, plan_);
  if (plan_.jobs.empty()) return;
  assert(plan_.jobs.size() <= mostJobs(beds_));
  host_.write(std::span<const shared::GrowthView>(&view, 1));
  host_.write(std::span<const shared::GrowthJob>(plan_.jobs), sizeof view);
}

void CapillaryPass::recordUpload(VkCommandBuffer commands) const {
  if (plan_.jobs.empty()) return;
  const VkBufferCopy used{0, 0, sizeof(shared::GrowthView) + plan_.jobs.size() * sizeof(shared::GrowthJob)};
  vkCmdCopyBuffer(commands, host_.handle(), frame_.handle(), 1, &used);
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
}

void CapillaryPass::recordGrowth(VkCommandBuffer commands, const Input& input, std::size_t number) const {
  const CapillaryBatch& batch = plan_.batches[number];
  const shared::CapillaryPush push{
      .points = input.points,
      .knots = input.knots,
      .spans = spans_.address(),
      .tables = tubes_.tables(),
      .growth = tables_.address(),
      .beds = bedBuffer_.address(),
      .colours = colours_.address(),
      .view = frame_.address(),
      .jobs = frame_.address() + sizeof(shared::GrowthView) + batch.firstJob * sizeof(shared::GrowthJob),
      .vertices = ring(number).address(),
      .jobCount = batch.jobCount,
      .curveCount = batch.curves,
      .edges = batch.edges,
      .hiddenKinds = input.draw.hiddenKinds,
  };
  grow_.dispatch(commands, push, gpu::groupsFor(batch.curves, 64));
}

void CapillaryPass::recordDraw(VkCommandBuffer commands, const Input& input, std::size_t number) const {
  const CapillaryBatch& batch = plan_.batches[number];
  pipelineFor(input.style, input.partial).bind(commands, input.draw);
  const VkBuffer buffer = ring(number).handle();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
  vkCmdBindIndexBuffer(commands, indices_[edgesIndex(batch.edges)].handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, 3 * ribbonTriangles(batch.edges) * batch.curves, 1, 0, 0, 0);
}

std::uint64_t CapillaryPass::ringBytes() const { return rings_[0].bytes() + rings_[1].bytes(); }

std::uint64_t CapillaryPass::bytes() const {
  std::uint64_t sum = ringBytes() + tables_.bytes() + bedBuffer_.bytes() + spans_.bytes() + colours_.bytes() +
                      host_.bytes() + frame_.bytes();
  for (const gpu::Buffer& indices : indices_) sum += indices.bytes();
  return sum;
}

}  // namespace vasa
