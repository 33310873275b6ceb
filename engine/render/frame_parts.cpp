#include <utility>

#include "gpu/barrier.h"
#include "render/renderer_state.h"

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

constexpr float kOcclusionReach = 0.03f;  // [m] about a vertebra

}  // namespace

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

}  // namespace vasa
