#include "render/renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/clock.h"
#include "render/renderer_state.h"

namespace vasa {
using namespace stage;
namespace {

constexpr std::chrono::milliseconds kPatience{10};  // of a step, with pipelines that are still being made
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

// Whether the frame's rounds did for all of its vessels.
bool Renderer::State::settleRounds(const Look& look) {
  if (anyVessels(look)) return rounds.settle(vessels.filling(), vessels.range());
  rounds.settleWithout();
  return true;
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

std::uint64_t Renderer::triangleCount() const { return state_->vessels.triangleCount(); }

std::uint64_t Renderer::drawnTriangleCount() const { return state_->rounds.drawnTriangles(); }

std::uint32_t Renderer::sweepCount() const { return state_->vessels.tubes().table().spanCount; }

std::uint64_t Renderer::templateBytes() const { return state_->vessels.bytes(); }

const RenderOptions& Renderer::options() const { return state_->options; }

}  // namespace vasa
