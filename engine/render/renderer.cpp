#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "core/clock.h"
#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/timer.h"
#include "render/capillary_pass.h"
#include "render/drawn_vessels.h"
#include "render/frame_stages.h"
#include "render/occlusion_pass.h"
#include "render/picture.h"
#include "render/rounds.h"
#include "render/skin_pass.h"

// A frame's parts (Part), in their order:
// - start: copy its points, knot frames and joints; choose m and n; pose the meshes; write template 0.
// - meshes: clear the picture, draw bones and heart.
// - rounds, one by one: write the next groups of tubes and forks into the other template, as many as it has
//   room for; draw this one; barrier.
// - patches, if the network has some, which were posed with template 0; ambient occlusion of what is there.
// - capillaries, batch by batch.
// - organs, where a picture is made in slices; else they belong to the end.
// - end: what is translucent; resolve.
// Each but the first is a stretch of the picture, and those with nothing between them are one stretch. One
// barrier a round keeps both templates apart: whatever wrote or read one of them before it is finished after
// it. Between two barriers a device may write one template while it draws the other.
namespace vasa {
using namespace stage;
namespace {

constexpr VkPipelineStageFlags2 kTemplateStages =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
    VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | gpu::kAttachmentStages |
    VK_PIPELINE_STAGE_2_TRANSFER_BIT;
constexpr std::chrono::milliseconds kPatience{10};  // of a step, with pipelines that are still being made
constexpr float kOcclusionReach = 0.03f;            // [m] about a vertebra
std::array<float, 4> clearColour(const Look& look) {
  if (look.transparent) return {0, 0, 0, 0};
  const vec4 c = linearColour(look.background);
  return {c.x, c.y, c.z, 1};
}

bool anyVessels(const Look& look) { return look.drawArteries || look.drawVeins || look.drawOtherVessels; }

MeshSet meshSetOf(gpu::Device& device, std::span<const SkinnedMesh> meshes, const RenderOptions& options) {
  if (options.levels) return {device, meshes, *options.levels};
  if (options.pixelError > 0) return {device, meshes, bodyLevels(meshes, options.skeleton)};
  BodyLevels all;
  for (const SkinnedMesh& mesh : meshes) all.push_back(oneLevel(mesh));
  return {device, meshes, all};
}

gpu::TargetSpec targetSpec(const RenderOptions& options) {
  assert(options.samples == 1 || options.samples == 4);
  return {.name = "picture",
          .size = {options.width * options.supersample, options.height * options.supersample},
          .colour = options.bgra ? VK_FORMAT_B8G8R8A8_SRGB : VK_FORMAT_R8G8B8A8_SRGB,
          .samples = VkSampleCountFlagBits(options.samples),
          .readDepth = options.occlusion};
}

FrameUpload uploadOf(gpu::Device& device, const DrawnVessels& vessels, const MeshSet& meshes) {
  const SweepTable& table = vessels.tubes().table();
  return {device, table.pointCount, table.knotCount, meshes.jointCount()};
}

gpu::BufferSpec readBackSpec(const gpu::Target& target) {
  return {"picture, host", target.pictureBytes(), gpu::MemoryRole::readBack};
}

}  // namespace

struct Renderer::State {
  State(gpu::Device& device, const Network& network, MeshSet posable, const RenderOptions& chosen);

  /// All at once. Capillaries wait until it is known that all vessels have had their room, since they cost
  /// more than all else.
  void draw(const RenderInput& input);
  void begin(const RenderInput& input);
  bool step();
  bool settleRounds(const Look& look);
  void take(const Network& network, const RenderOptions& other);
  void grow(const Growth* growth, const CapillaryWish& wish);
  /// @param tubes  written by DrawnVessels::recordStatic()
  double timeStatic(const StaticTubes& tubes, const RenderInput& input);
  shared::DetailView viewOf(const Camera& camera, const Look& look) const;

  gpu::Device& device;
  RenderOptions options;
  void setColours(std::span<const std::uint32_t> given);

  DrawnVessels vessels;
  MeshSet meshes;
  FrameUpload upload;
  SkinPass skinPass;
  gpu::Target target;
  SurfacePass surfacePass;
  std::optional<OcclusionPass> occlusionPass;
  Rounds rounds;
  std::uint32_t timedRounds = 1;  // that the timer has room for
  std::optional<CapillaryPass> capillaries;
  gpu::Buffer readBack;
  std::optional<gpu::GpuTimer> timer;
  gpu::GpuTimer staticTimer;
  FrameTimes times;
  std::vector<MeshSet::Level> levels;  // of the picture that was started last
  bool transparent = false;
  bool partial = false, cull = true;  // of this frame

  enum class Part { start, meshes, rounds, patches, occlusion, capillaries, organs, end, done };
  struct Frame {
    shared::DrawPush push;
    Camera camera;
    Look look;
    std::span<const MeshSet::Level> levels;
    float heartScale;
    bool waits;
    std::uint32_t rounds;  // of tubes and forks
    bool patched, occludes, grows;
    bool sliced;    // a slice at a time is recorded
    bool split;     // bones and heart are a stretch of their own
    bool wholeEnd;  // nothing comes between the last round and what is translucent
    Part next = Part::start;
    std::uint32_t round = 0;  // the next one
    std::size_t batch = 0;    // likewise, of capillaries
  };
  std::optional<Frame> begun;  // a picture in slices

 private:
  /// Takes what is in the input's spans.
  Frame start(const RenderInput& input, bool sliced);
  void makeRoom();
  static Part partFrom(const Frame& frame, Part from);
  /// What comes next.
  void record(VkCommandBuffer commands, Frame& frame);
  /// What comes next, and more until a part is next.
  void drawUntil(Part part, Frame& frame);
  void recordStart(VkCommandBuffer commands, const Frame& frame);
  void recordMeshes(VkCommandBuffer commands, const Frame& frame);
  void recordRound(VkCommandBuffer commands, Frame& frame);
  void recordEnd(VkCommandBuffer commands, const Frame& frame);
  void recordTranslucent(VkCommandBuffer commands, const Frame& frame, MeshRole role);
  void recordOrgans(VkCommandBuffer commands, const Frame& frame);
  void recordPatches(VkCommandBuffer commands, const Frame& frame);
  DrawnVessels::Frame ofVessels() { return {upload, *timer, cull}; }
  void recordOcclusion(VkCommandBuffer commands, const Frame& frame);
  void recordCapillaries(VkCommandBuffer commands, const Frame& frame, std::size_t from, std::size_t to);
};

Renderer::State::State(gpu::Device& dev, const Network& network, MeshSet posable, const RenderOptions& chosen)
    : device(dev),
      options(chosen),
      vessels(device, network, options),
      meshes(std::move(posable)),
      upload(uploadOf(device, vessels, meshes)),
      skinPass(device),
      target(device, targetSpec(chosen)),
      surfacePass(device, target.spec()),
      readBack(device, readBackSpec(target)),
      staticTimer(device, 1) {
  timer.emplace(device, chosen.timed ? kScopes + kScopesOfRound : 0);
  if (chosen.occlusion) occlusionPass.emplace(device, target);
  grow(chosen.growth, chosen.capillaries);
}

void Renderer::State::setColours(std::span<const std::uint32_t> given) {
  const std::vector<std::uint32_t> colours = vessels.setColours(given);
  if (capillaries) capillaries->setSpanColours(device, colours);
}

void Renderer::State::recordStart(VkCommandBuffer commands, const Frame& frame) {
  const bool any = anyVessels(frame.look);
  upload.record(commands);
  if (any) vessels.recordStart(commands, ofVessels(), viewOf(frame.camera, frame.look));
  if (any) vessels.recordFill(commands, ofVessels(), 0);
  if (frame.patched) vessels.recordPatches(commands, ofVessels());
  const auto scope = timer->scope(commands, kMeshes);
  skinPass.record(commands, meshes, frame.levels, upload.joints(), upload.jointCount(), frame.heartScale);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::recordMeshes(VkCommandBuffer commands, const Frame& frame) {
  const auto scope = timer->scope(commands, kMeshes);
  target.begin(commands, clearColour(frame.look), 0, gpu::Stretch::first);
  surfacePass.recordOpaque(commands, frame.push, meshes, frame.levels, frame.look, partial);
  target.pause(commands);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::recordRound(VkCommandBuffer commands, Frame& frame) {
  const std::uint32_t k = frame.round++;
  if (k + 1 < frame.rounds) vessels.recordFill(commands, ofVessels(), k + 1);
  const bool starts = k == 0 && !frame.split, last = frame.round >= frame.rounds,
             ends = last && frame.wholeEnd;
  {
    const auto scope = timer->scope(commands, kDraw);
    target.begin(commands, clearColour(frame.look), 0,
                 starts ? (ends ? gpu::Stretch::only : gpu::Stretch::first)
                 : ends ? gpu::Stretch::last
                        : gpu::Stretch::middle);
    if (starts) surfacePass.recordOpaque(commands, frame.push, meshes, frame.levels, frame.look, partial);
    if (frame.rounds > 0)
      surfacePass.recordVessels(commands, frame.push, vessels.drawsOfRound(k), frame.look, partial);
    if (ends) {
      recordEnd(commands, frame);
    } else {
      target.pause(commands);
      gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
    }
  }
  if (last && anyVessels(frame.look)) vessels.recordEnd(commands);
}

void Renderer::State::recordEnd(VkCommandBuffer commands, const Frame& frame) {
  if (!frame.sliced) recordTranslucent(commands, frame, MeshRole::organs);
  recordTranslucent(commands, frame, MeshRole::skin);
  target.end(commands);
}

void Renderer::State::recordTranslucent(VkCommandBuffer commands, const Frame& frame, MeshRole role) {
  surfacePass.recordTranslucent(commands, frame.push, meshes, frame.levels, role, frame.look, partial);
}

void Renderer::State::recordOrgans(VkCommandBuffer commands, const Frame& frame) {
  const auto scope = timer->scope(commands, kMeshes);
  target.begin(commands, {}, 0, gpu::Stretch::middle);
  recordTranslucent(commands, frame, MeshRole::organs);
  target.pause(commands);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::recordPatches(VkCommandBuffer commands, const Frame& frame) {
  const auto scope = timer->scope(commands, kDraw);
  target.begin(commands, {}, 0, gpu::Stretch::middle);
  surfacePass.recordVessels(commands, frame.push, vessels.drawsOfPatches(), frame.look, partial);
  target.pause(commands);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

// Before the capillaries: curves thinner than a pixel would only lay noise over one another.
void Renderer::State::recordOcclusion(VkCommandBuffer commands, const Frame& frame) {
  const auto scope = timer->scope(commands, kMeshes);
  occlusionPass->record(commands, target, frame.camera, kOcclusionReach, frame.look.occlusion);
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

void Renderer::State::recordCapillaries(VkCommandBuffer commands, const Frame& frame, std::size_t from,
                                        std::size_t to) {
  CapillaryPass::Input input{upload.points(), upload.knots(), frame.push, frame.look.style, partial};
  input.draw.opacity = frame.look.capillaryOpacity;
  if (from == 0) capillaries->recordUpload(commands);
  for (std::size_t batch = from; batch < to; ++batch) {
    if (batch == from) capillaries->recordGrowth(commands, input, batch);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
    if (batch + 1 < to) capillaries->recordGrowth(commands, input, batch + 1);
    target.begin(commands, {}, 0, gpu::Stretch::middle);
    capillaries->recordDraw(commands, input, batch);
    target.pause(commands);
  }
  gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
}

shared::DetailView Renderer::State::viewOf(const Camera& camera, const Look& look) const {
  return detailView(camera, look, pictureGrid(device, target.spec().size, options.samples),
                    vessels.tubes().detail());
}

// For as many rounds as come next.
void Renderer::State::makeRoom() {
  if (rounds.next() > 1) vessels.makeRoom();
  if (options.timed && timedRounds < rounds.next())
    timer.emplace(device, kScopes + kScopesOfRound * (timedRounds = rounds.next()));
}

Renderer::State::Frame Renderer::State::start(const RenderInput& input, bool sliced) {
  const auto from = Clock::now();
  upload.write(input.points, input.knotFrames, input.jointMatrices);
  if (capillaries)
    capillaries->prepare(input.points, input.knotFrames,
                         growthView(input.camera, target.spec().size, options.seed));
  times = {.upload = msSince(from)};
  transparent = input.look.transparent;
  makeRoom();
  const bool any = anyVessels(input.look);
  partial = isPartial(input.camera, input.look);
  // The backs of what is cut open are seen, and samples elsewhere than the passes look at would miss
  // triangles.
  cull = options.cull && !input.camera.cut && device.limits().standardSampleLocations;
  meshes.levelsFor(input.look, input.jointMatrices, input.camera, target.spec().size.height,
                   meshPixelError(options.pixelError) / std::sqrt(float(options.samples)), levels);
  Frame frame{.push = drawConstants(input.camera, input.look, target.spec().size),
              .camera = input.camera,
              .look = input.look,
              .levels = levels,
              .heartScale = input.heartScale,
              .waits = input.waits,
              .rounds = any ? rounds.next() : 0,
              .patched = any && vessels.anyPatches(),
              // Depth of what is translucent is grain.
              .occludes = occlusionPass && input.look.occlusion > 0 && !anyTranslucent(input.look) &&
                          input.look.style != LookStyle::xray,
              .grows = capillaries && any && input.look.capillaryOpacity > 0 && capillaries->batches() > 0,
              .sliced = sliced,
              .split = options.timed || sliced,
              .wholeEnd = false};
  frame.wholeEnd = !(frame.split || frame.patched || frame.occludes || frame.grows);
  return frame;
}

// The first part from one on that a picture has.
Renderer::State::Part Renderer::State::partFrom(const Frame& frame, Part from) {
  if (from <= Part::patches && frame.patched) return Part::patches;
  if (from <= Part::occlusion && frame.occludes) return Part::occlusion;
  if (from <= Part::capillaries && frame.grows) return Part::capillaries;
  return frame.sliced ? Part::organs : Part::end;
}

void Renderer::State::record(VkCommandBuffer commands, Frame& frame) {
  switch (frame.next) {
    case Part::start:
      recordStart(commands, frame);
      frame.next = frame.split ? Part::meshes : Part::rounds;
      return;
    case Part::meshes:
      recordMeshes(commands, frame);
      frame.next = frame.rounds > 0 ? Part::rounds : partFrom(frame, Part::patches);
      return;
    case Part::rounds:
      recordRound(commands, frame);
      if (frame.round >= frame.rounds)
        frame.next = frame.wholeEnd ? Part::done : partFrom(frame, Part::patches);
      return;
    case Part::patches:
      recordPatches(commands, frame);
      frame.next = partFrom(frame, Part::occlusion);
      return;
    case Part::occlusion:
      recordOcclusion(commands, frame);
      frame.next = partFrom(frame, Part::capillaries);
      return;
    case Part::capillaries: {
      const auto scope = timer->scope(commands, kCapillaries);
      const std::size_t to = frame.sliced ? frame.batch + 1 : capillaries->batches();
      recordCapillaries(commands, frame, std::exchange(frame.batch, to), to);
      if (to == capillaries->batches()) frame.next = partFrom(frame, Part::organs);
      return;
    }
    case Part::organs:
      recordOrgans(commands, frame);
      frame.next = Part::end;
      return;
    case Part::end: {
      const auto scope = timer->scope(commands, kMeshes);
      target.begin(commands, {}, 0, gpu::Stretch::last);
      recordEnd(commands, frame);
      frame.next = Part::done;
      return;
    }
    case Part::done:
      return;
  }
}

// Whether the frame's rounds did for all of its vessels.
bool Renderer::State::settleRounds(const Look& look) {
  if (anyVessels(look)) return rounds.settle(vessels.filling(), vessels.range());
  rounds.settleWithout();
  return true;
}

double Renderer::State::timeStatic(const StaticTubes& tubesAtOnce, const RenderInput& input) {
  const shared::DrawPush push = drawConstants(input.camera, input.look, target.spec().size);
  gpu::Commands commands = device.queue().begin("static draw");
  staticTimer.begin(commands);
  if (vessels.anyPatches()) {
    vessels.recordStaticPatches(commands);
    gpu::stageBarrier(commands, kTemplateStages, kTemplateStages);
  }
  target.begin(commands, clearColour(input.look), 0, gpu::Stretch::first);
  target.pause(commands);
  gpu::stageBarrier(commands, gpu::kAttachmentStages, gpu::kAttachmentStages);
  {
    const auto scope = staticTimer.scope(commands, kDraw);
    target.begin(commands, {}, 0, gpu::Stretch::middle);
    tubesAtOnce.recordDraw(commands, surfacePass, push);
    if (vessels.anyPatches()) surfacePass.recordVessels(commands, push, vessels.drawsOfPatches());
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
    : state_(std::make_unique<State>(device, network, meshSetOf(device, meshes, options), options)) {}
Renderer::Renderer(gpu::Device& device, const Network& network, const Renderer& sameBody,
                   const RenderOptions& options)
    : state_(std::make_unique<State>(device, network, MeshSet::sharing(device, sameBody.state_->meshes),
                                     options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::setSweepColours(std::span<const std::uint32_t> colours) {
  state_->begun.reset();
  state_->setColours(colours);
}

void Renderer::State::drawUntil(Part part, Frame& frame) {
  if (frame.next == Part::start) vessels.settle(frame.waits);
  const bool vesselsCame = frame.next < Part::patches;
  gpu::Commands commands = device.queue().begin("frame");
  timer->begin(commands);
  do record(commands, frame);
  while (frame.next < part);
  device.queue().wait(device.queue().submit(std::move(commands)));
  addTo(times, *timer);
  if (!vesselsCame || frame.next < Part::patches || settleRounds(frame.look)) return;
  // Once more, with as many rounds as it takes.
  times = {.upload = times.upload, .total = times.total};
  makeRoom();
  frame.rounds = rounds.next();
  frame.round = 0;
  frame.next = Part::start;
}

void Renderer::State::draw(const RenderInput& input) {
  const auto from = Clock::now();
  begun.reset();
  Frame frame = start(input, false);
  const Part first = frame.grows ? Part::capillaries : Part::done;
  while (frame.next < first) drawUntil(first, frame);
  if (frame.next < Part::done) drawUntil(Part::done, frame);
  times.total = msSince(from);
}

void Renderer::State::begin(const RenderInput& input) {
  const auto from = Clock::now();
  begun.reset();
  begun = start(input, true);
  times.total = msSince(from);
}

bool Renderer::State::step() {
  if (!begun) return false;
  if (!vessels.isSettled(kPatience)) return true;
  const auto from = Clock::now();
  drawUntil(Part::start, *begun);
  times.total += msSince(from);
  if (begun->next == Part::done) begun.reset();
  return begun.has_value();
}

void Renderer::draw(const RenderInput& input) { state_->draw(input); }
void Renderer::begin(const RenderInput& input) { state_->begin(input); }
bool Renderer::step() { return state_->step(); }

void Renderer::State::take(const Network& network, const RenderOptions& other) {
  begun.reset();
  options.shape = other.shape;
  options.pixelError = other.pixelError;
  options.forks = other.forks;
  vessels.take(network, other);
  upload = uploadOf(device, vessels, meshes);
  grow(nullptr, {});
}

void Renderer::State::grow(const Growth* growth, const CapillaryWish& wish) {
  begun.reset();
  capillaries.reset();
  if (growth && wish.levels > 0)
    capillaries.emplace(device, target.spec(), vessels.tubes(), growth->rules, growth->beds, wish);
  setColours({});
}

void Renderer::take(const Network& network, const RenderOptions& options) { state_->take(network, options); }
void Renderer::grow(const Growth* growth, const CapillaryWish& wish) { state_->grow(growth, wish); }

void Renderer::resize(std::uint32_t width, std::uint32_t height) {
  State& s = *state_;
  if (width == s.options.width && height == s.options.height) return;
  s.begun.reset();
  s.options.width = width;
  s.options.height = height;
  s.target = gpu::Target(s.device, targetSpec(s.options));
  s.readBack = gpu::Buffer(s.device, readBackSpec(s.target));
  if (s.occlusionPass) s.occlusionPass->resize(s.device, s.target);
}

const gpu::Image& Renderer::picture() const { return state_->target.picture(); }

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
  return toImage(averaged(pixels, s.options.width, s.options.height, n), s.options.width, s.options.height,
                 s.transparent);
}

bool Renderer::isSettled(std::chrono::milliseconds within) const { return state_->vessels.isSettled(within); }

FrameTimes Renderer::times() const { return state_->times; }

CapillaryCounts Renderer::capillaryCounts() const {
  if (!state_->capillaries) return {};
  const CapillaryPlan& plan = state_->capillaries->plan();
  return {plan.trees, plan.curves, plan.wishedCurves, state_->capillaries->bytes(),
          state_->capillaries->ringBytes()};
}

double Renderer::staticDraw(const RenderInput& input, unsigned repeats) {
  State& s = *state_;
  s.begun.reset();
  s.vessels.settle();
  const StaticTubes tubes = s.vessels.makeStatic();
  s.upload.write(input.points, input.knotFrames, input.jointMatrices);
  gpu::Commands commands = s.device.queue().begin("static vertices");
  s.upload.record(commands);
  s.vessels.recordStatic(commands, {s.upload, *s.timer}, s.viewOf(input.camera, input.look), tubes);
  s.device.queue().wait(s.device.queue().submit(std::move(commands)));
  double best = s.timeStatic(tubes, input);
  for (unsigned i = 1; i < repeats; ++i) best = std::min(best, s.timeStatic(tubes, input));
  return best;
}

std::uint64_t Renderer::triangleCount() const { return state_->vessels.triangleCount(); }

std::uint64_t Renderer::drawnTriangleCount() const { return state_->rounds.drawnTriangles(); }

std::uint32_t Renderer::sweepCount() const { return state_->vessels.tubes().table().spanCount; }

std::uint64_t Renderer::templateBytes() const { return state_->vessels.bytes(); }

const RenderOptions& Renderer::options() const { return state_->options; }

}  // namespace vasa
