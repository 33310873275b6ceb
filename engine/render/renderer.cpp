#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/clock.h"
#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/timer.h"
#include "render/capillary_pass.h"
#include "render/frame_upload.h"
#include "render/occlusion_pass.h"
#include "render/patch_pass.h"
#include "render/picture.h"
#include "render/skin_pass.h"
#include "render/static_tubes.h"

// A frame:
//   copy the frame's points, knot frames and joints; choose m and n; pose the meshes; write template 0
//   picture, first stretch: clear, bones and heart
//   for each batch k: write batch k+1 into the other template; stretch: draw batch k; barrier
//   stretch: patches, if the network has some, which were posed with batch 0
//   ambient occlusion of what is there
//   likewise batch by batch: capillaries
//   picture, last stretch: skin; resolve
// One barrier a batch keeps both templates apart: whatever wrote or read one of them before it is finished
// after it. Between two barriers a device may write one template while it draws the other.
namespace vasa {
namespace {

constexpr VkPipelineStageFlags2 kTemplateStages =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
    VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | gpu::kAttachmentStages |
    VK_PIPELINE_STAGE_2_TRANSFER_BIT;
constexpr float kOcclusionReach = 0.03f;  // [m] about a vertebra
constexpr const char* kTessellate = "tessellate";
constexpr const char* kForks = "forks";
constexpr const char* kDraw = "draw tubes";
constexpr const char* kCapillaries = "capillaries";
constexpr const char* kMeshes = "meshes";

std::array<float, 4> clearColour(const Look& look) {
  if (look.transparent) return {0, 0, 0, 0};
  const vec4 c = linearColour(look.background);
  return {c.x, c.y, c.z, 1};
}

bool anyVessels(const Look& look) {
  return look.drawArteries || look.drawVeins || look.drawOtherVessels;
}

// One to be written while the other is drawn, where there are several batches.
template <class Set>
std::vector<TubeDraws> templatesFor(gpu::Device& device, const Set& set) {
  std::vector<TubeDraws> made;
  for (std::size_t i = 0; i < std::min<std::size_t>(set.batches().size(), 2); ++i)
    made.emplace_back(device, set.room(), set.groupsPerBatch());
  return made;
}

VkDeviceSize bytesOf(std::span<const TubeDraws> templates) {
  VkDeviceSize bytes = 0;
  for (const TubeDraws& draws : templates) bytes += draws.bytes();
  return bytes;
}

BodyLevels levelsOf(std::span<const SkinnedMesh> meshes, const RenderOptions& options) {
  if (options.pixelError <= 0) {
    BodyLevels all;
    for (const SkinnedMesh& mesh : meshes) all.push_back(oneLevel(mesh));
    return all;
  }
  return options.levels ? *options.levels : bodyLevels(meshes);
}

gpu::TargetSpec targetSpec(const RenderOptions& options) {
  assert(options.samples == 1 || options.samples == 4);
  return {.name = "picture",
          .size = {options.width * options.supersample, options.height * options.supersample},
          .colour = options.bgra ? VK_FORMAT_B8G8R8A8_SRGB : VK_FORMAT_R8G8B8A8_SRGB,
          .samples = VkSampleCountFlagBits(options.samples),
          .readDepth = options.occlusion};
}

gpu::BufferSpec readBackSpec(const gpu::Target& target) {
  return {"picture, host", target.pictureBytes(), gpu::MemoryRole::readBack};
}

}  // namespace

struct Renderer::State {
  State(gpu::Device& device, const Network& network, std::span<const SkinnedMesh> skinned,
        const RenderOptions& chosen);

  void record(VkCommandBuffer commands, const RenderInput& input);
  double timeStatic(const StaticTubes& tubes, const RenderInput& input);
  shared::DetailView viewOf(const RenderInput& input) const;

  gpu::Device& device;
  RenderOptions options;
  std::size_t batchCount() const { return tubes.batches().size() + forks.batches().size(); }
  std::uint32_t groupCount() const { return tubes.groupCount() + forks.groupCount(); }
  void setColours(std::span<const std::uint32_t> given);

  std::vector<std::uint32_t> ownColours;  // of the spans, by their vessels' kinds
  TubeSet tubes;
  ForkSet forks;
  PatchSet patches;
  MeshSet meshes;
  FrameUpload upload;
  DetailPass detailPass;
  TubePass tubePass;
  ForkPass forkPass;
  std::optional<PatchPass> patchPass;  // where there are patches
  SkinPass skinPass;
  gpu::Target target;
  SurfacePass surfacePass;
  std::optional<OcclusionPass> occlusionPass;
  std::vector<TubeDraws> templates, forkTemplates;
  std::optional<CapillaryPass> capillaries;
  gpu::Buffer readBack;
  gpu::Buffer drawn;  // every group's draw of the latest frame, where frames are timed
  gpu::GpuTimer timer, staticTimer;
  FrameTimes times;
  bool transparent = false;
  bool partial = false, cull = true;  // of this frame

 private:
  const TubeDraws& templateOf(std::size_t batch) const;
  void recordTessellation(VkCommandBuffer commands, std::size_t batch);
  void recordBatch(VkCommandBuffer commands, const shared::DrawPush& push, std::size_t batch, const Look& look);
  void copyDraws(VkCommandBuffer commands, const TubeDraws& from, std::uint32_t group, std::uint32_t groups);
  void recordPatches(VkCommandBuffer commands, const shared::DrawPush& push, const Look& look);
  void recordOcclusion(VkCommandBuffer commands, const RenderInput& input);
  void recordCapillaries(VkCommandBuffer commands, shared::DrawPush push, const Look& look);
};

Renderer::State::State(gpu::Device& dev, const Network& network, std::span<const SkinnedMesh> skinned,
                       const RenderOptions& chosen)
    : device(dev),
      options(chosen),
      ownColours(kindColours(network)),
      tubes(device, network, {chosen.shape, chosen.pixelError, chosen.forks, chosen.table}, chosen.sweepsPerBatch),
      forks(device, tubes.table(), tubes.detail(), chosen.sweepsPerBatch),
      patches(device, tubes.table().patches),
      meshes(device, skinned, levelsOf(skinned, chosen)),
      upload(device, tubes.table().pointCount, tubes.table().knotCount, meshes.jointCount()),
      detailPass(device, tubes),
      tubePass(device, chosen.samples),
      forkPass(device, chosen.samples),
      skinPass(device),
      target(device, targetSpec(chosen)),
      surfacePass(device, target.spec()),
      templates(templatesFor(device, tubes)),
      forkTemplates(templatesFor(device, forks)),
      readBack(device, readBackSpec(target)),
      drawn(device, {"draws, host", sizeof(shared::DrawCommand) * (chosen.timed ? groupCount() : 0),
                     gpu::MemoryRole::readBack}),
      timer(device, chosen.timed ? std::uint32_t(2 * batchCount() + 7) : 0),
      staticTimer(device, 1) {
  if (!patches.empty()) patchPass.emplace(device, chosen.samples);
  if (chosen.occlusion) occlusionPass.emplace(device, target);
  if (options.growth && options.capillaries.levels > 0)
    capillaries.emplace(device, target.spec(), tubes, options.growth->rules, options.growth->sites, options.capillaries);
  setColours({});
}

void Renderer::State::setColours(std::span<const std::uint32_t> given) {
  const std::vector<std::uint32_t> colours = recoloured(ownColours, given);
  tubes.setSpanColours(device, colours);
  forks.setSpanColours(device, colours);
  patches.setSpanColours(device, colours);
  if (capillaries) capillaries->setSpanColours(device, colours);
}

// Of a batch of tubes or, behind those, of forks.
const TubeDraws& Renderer::State::templateOf(std::size_t batch) const {
  const std::size_t tubeBatches = tubes.batches().size();
  return batch < tubeBatches ? templates[batch % 2] : forkTemplates[(batch - tubeBatches) % 2];
}

void Renderer::State::recordTessellation(VkCommandBuffer commands, std::size_t batch) {
  const std::size_t tubeBatches = tubes.batches().size();
  const auto scope = timer.scope(commands, batch < tubeBatches ? kTessellate : kForks);
  if (batch < tubeBatches)
    tubePass.record(commands, {tubes, tubes.batches()[batch], detailPass, upload.points(), upload.knots(),
                               templateOf(batch), cull});
  else
    forkPass.record(commands, {tubes, forks, forks.batches()[batch - tubeBatches], detailPass, upload.points(),
                               upload.knots(), templateOf(batch), cull});
}

void Renderer::State::recordBatch(VkCommandBuffer commands, const shared::DrawPush& push, std::size_t batch,
                                  const Look& look) {
  const auto scope = timer.scope(commands, kDraw);
  target.begin(commands, {}, 0, gpu::Stretch::middle);
  const std::size_t tubeBatches = tubes.batches().size();
  const TubeDraws& draws = templateOf(batch);
  if (batch < tubeBatches) {
    const TubeBatch& range = tubes.batches()[batch];
    surfacePass.recordVessels(commands, push, draws, range.groups(), look, partial);
    target.pause(commands);
    copyDraws(commands, draws, range.firstSweep / shared::kGroupSweeps, range.groups());
  } else {
    const ForkBatch& range = forks.batches()[batch - tubeBatches];
    surfacePass.recordVessels(commands, push, draws, range.groups(), look, partial);
    target.pause(commands);
    copyDraws(commands, draws, tubes.groupCount() + range.firstFork / shared::kGroupForks, range.groups());
  }
}

void Renderer::State::recordPatches(VkCommandBuffer commands, const shared::DrawPush& push, const Look& look) {
  const auto scope = timer.scope(commands, kDraw);
  target.begin(commands, {}, 0, gpu::Stretch::middle);
  surfacePass.recordVessels(commands, push, patches.draws(), patches.groups(), look, partial);
  target.pause(commands);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::copyDraws(VkCommandBuffer commands, const TubeDraws& from, std::uint32_t group,
                                std::uint32_t groups) {
  if (drawn.bytes() == 0) return;
  constexpr VkDeviceSize each = sizeof(shared::DrawCommand);
  const VkBufferCopy copy{0, each * group, each * groups};
  vkCmdCopyBuffer(commands, from.draws.handle(), drawn.handle(), 1, &copy);
}

// Before the capillaries: curves thinner than a pixel would only lay noise over one another.
void Renderer::State::recordOcclusion(VkCommandBuffer commands, const RenderInput& input) {
  const auto scope = timer.scope(commands, kMeshes);
  occlusionPass->record(commands, target, input.camera, kOcclusionReach, input.look.occlusion);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::recordCapillaries(VkCommandBuffer commands, shared::DrawPush push, const Look& look) {
  push.opacity = look.capillaryOpacity;
  const auto scope = timer.scope(commands, kCapillaries);
  const CapillaryPass::Input input{upload.points(), upload.knots(), push, look.style, partial};
  capillaries->recordUpload(commands);
  for (std::size_t batch = 0; batch < capillaries->batches(); ++batch) {
    if (batch == 0) capillaries->recordGrowth(commands, input, batch);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
    if (batch + 1 < capillaries->batches()) capillaries->recordGrowth(commands, input, batch + 1);
    target.begin(commands, {}, 0, gpu::Stretch::middle);
    capillaries->recordDraw(commands, input, batch);
    target.pause(commands);
  }
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

shared::DetailView Renderer::State::viewOf(const RenderInput& input) const {
  return detailView(input.camera, input.look, target.spec().size, tubes.detail(),
                    detailSnap(device, target.spec().size));
}

void Renderer::State::record(VkCommandBuffer commands, const RenderInput& input) {
  const shared::DrawPush push = drawConstants(input.camera, input.look, target.spec().size);
  const std::size_t batches = anyVessels(input.look) ? batchCount() : 0;
  partial = isPartial(input.camera, input.look);
  // The backs of what is cut open are seen, and samples elsewhere than the passes look at would miss triangles.
  cull = options.cull && !input.camera.cut && device.limits().standardSampleLocations;
  const std::vector<MeshSet::Level> levels =
      meshes.levelsFor(input.look, input.jointMatrices, input.camera, target.spec().size.height,
                       meshPixelError(options.pixelError) / std::sqrt(float(options.samples)));
  timer.begin(commands);
  upload.record(commands);
  if (batches > 0) {
    const auto scope = timer.scope(commands, kTessellate);
    detailPass.record(commands, tubes, upload.points(), viewOf(input));
  }
  if (batches > 0) recordTessellation(commands, 0);
  if (batches > 0 && patchPass) {
    const auto scope = timer.scope(commands, kForks);
    patchPass->record(commands, {tubes, patches, detailPass, upload.points(), upload.knots(), cull});
  }
  {
    const auto scope = timer.scope(commands, kMeshes);
    skinPass.record(commands, meshes, levels, upload.joints(), upload.jointCount(), input.heartScale);
    gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT);
    target.begin(commands, clearColour(input.look), 0, gpu::Stretch::first);
    surfacePass.recordOpaque(commands, push, meshes, levels, input.look, partial);
    target.pause(commands);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
  }
  for (std::size_t batch = 0; batch < batches; ++batch) {
    if (batch + 1 < batches) recordTessellation(commands, batch + 1);
    recordBatch(commands, push, batch, input.look);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
  }
  if (batches > 0 && patchPass) recordPatches(commands, push, input.look);
  // Depth of what is translucent is grain.
  if (occlusionPass && input.look.occlusion > 0 && !anyTranslucent(input.look) && input.look.style != LookStyle::xray) recordOcclusion(commands, input);
  if (capillaries && batches > 0 && input.look.capillaryOpacity > 0) recordCapillaries(commands, push, input.look);
  const auto scope = timer.scope(commands, kMeshes);
  target.begin(commands, {}, 0, gpu::Stretch::last);
  surfacePass.recordTranslucent(commands, push, meshes, levels, input.look, partial);
  target.end(commands);
}

double Renderer::State::timeStatic(const StaticTubes& tubesAtOnce, const RenderInput& input) {
  const shared::DrawPush push = drawConstants(input.camera, input.look, target.spec().size);
  gpu::Commands commands = device.queue().begin("static draw");
  staticTimer.begin(commands);
  if (patchPass) {
    patchPass->recordTriangles(commands, patches, detailPass, false);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
  }
  target.begin(commands, clearColour(input.look), 0, gpu::Stretch::first);
  target.pause(commands);
  gpu::stageBarrier(commands, gpu::kAttachmentStages, gpu::kAttachmentStages);
  {
    const auto scope = staticTimer.scope(commands, kDraw);
    target.begin(commands, {}, 0, gpu::Stretch::middle);
    tubesAtOnce.recordDraw(commands, surfacePass, push);
    if (patchPass) surfacePass.recordVessels(commands, push, patches.draws(), patches.groups());
    target.pause(commands);
  }
  gpu::stageBarrier(commands, gpu::kAttachmentStages, gpu::kAttachmentStages);
  target.begin(commands, {}, 0, gpu::Stretch::last);
  target.end(commands);
  device.queue().wait(device.queue().submit(std::move(commands)));
  const auto results = staticTimer.results();
  return results.empty() ? 0 : results.front().ms;
}

Renderer::Renderer(gpu::Device& device, const Network& network, std::span<const SkinnedMesh> meshes,
                   const RenderOptions& options)
    : state_(std::make_unique<State>(device, network, meshes, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::setSweepColours(std::span<const std::uint32_t> colours) {
  state_->setColours(colours);
}

void Renderer::draw(const RenderInput& input) {
  State& s = *state_;
  const auto start = Clock::now();
  s.upload.write(input.points, input.knotFrames, input.jointMatrices);
  if (s.capillaries) s.capillaries->prepare(input.points, growthView(input.camera, s.target.spec().size, s.options.seed));
  s.times = {.upload = msSince(start)};
  gpu::Commands commands = s.device.queue().begin("frame");
  s.record(commands, input);
  s.transparent = input.look.transparent;
  s.device.queue().wait(s.device.queue().submit(std::move(commands)));
  s.times.total = msSince(start);
  for (const auto& [name, ms] : s.timer.results()) {
    const std::string_view stage(name);
    (stage == kTessellate    ? s.times.tessellate
     : stage == kForks       ? s.times.forks
     : stage == kDraw        ? s.times.draw
     : stage == kCapillaries ? s.times.capillaries
                             : s.times.meshes) += ms;
  }
}

void Renderer::resize(std::uint32_t width, std::uint32_t height) {
  State& s = *state_;
  if (width == s.options.width && height == s.options.height) return;
  s.options.width = width;
  s.options.height = height;
  s.target = gpu::Target(s.device, targetSpec(s.options));
  s.readBack = gpu::Buffer(s.device, readBackSpec(s.target));
  if (s.occlusionPass) s.occlusionPass->resize(s.device, s.target);
}

const gpu::Image& Renderer::picture() const {
  return state_->target.picture();
}

Image Renderer::readBack() {
  State& s = *state_;
  gpu::Commands commands = s.device.queue().begin("read back");
  s.target.copyPicture(commands, s.readBack);
  s.device.queue().wait(s.device.queue().submit(std::move(commands)));
  s.readBack.invalidate();
  const std::uint32_t n = s.options.supersample;
  const auto pixels = s.readBack.mapped<std::uint8_t>();
  if (s.options.bgra) swapRedAndBlue(pixels);
  if (n == 1) return toImage(pixels, s.options.width, s.options.height, s.transparent);
  return toImage(averaged(pixels, s.options.width, s.options.height, n), s.options.width, s.options.height, s.transparent);
}

FrameTimes Renderer::times() const {
  return state_->times;
}

CapillaryCounts Renderer::capillaryCounts() const {
  if (!state_->capillaries) return {};
  const CapillaryPlan& plan = state_->capillaries->plan();
  return {plan.trees, plan.curves, plan.wishedCurves, state_->capillaries->bytes(), state_->capillaries->ringBytes()};
}

double Renderer::staticDraw(const RenderInput& input, unsigned repeats) {
  State& s = *state_;
  const StaticTubes tubes(s.device, s.tubes, s.forks);
  s.upload.write(input.points, input.knotFrames, input.jointMatrices);
  gpu::Commands commands = s.device.queue().begin("static vertices");
  s.upload.record(commands);
  s.detailPass.record(commands, s.tubes, s.upload.points(), s.viewOf(input));
  if (s.patchPass) s.patchPass->record(commands, {s.tubes, s.patches, s.detailPass, s.upload.points(), s.upload.knots()});
  tubes.recordVertices(commands, s.tubePass, s.forkPass, s.detailPass, s.upload.points(), s.upload.knots());
  s.device.queue().wait(s.device.queue().submit(std::move(commands)));
  double best = s.timeStatic(tubes, input);
  for (unsigned i = 1; i < repeats; ++i) best = std::min(best, s.timeStatic(tubes, input));
  return best;
}

std::uint64_t Renderer::triangleCount() const {
  const State& s = *state_;
  const std::uint64_t patches = s.options.pixelError > 0 ? 0 : s.patches.triangleCount(s.options.shape.around);
  return s.tubes.triangleCount() + s.forks.triangleCount() + patches;
}

std::uint64_t Renderer::drawnTriangleCount() const {
  state_->drawn.invalidate();
  std::uint64_t indices = 0;
  for (const shared::DrawCommand& draw : state_->drawn.mapped<const shared::DrawCommand>()) indices += draw.indexCount;
  return indices / 3;
}

std::uint32_t Renderer::sweepCount() const {
  return state_->tubes.table().spanCount;
}

std::uint64_t Renderer::templateBytes() const {
  return bytesOf(state_->templates) + bytesOf(state_->forkTemplates) + state_->patches.bytes();
}

const RenderOptions& Renderer::options() const {
  return state_->options;
}

}  // namespace vasa
