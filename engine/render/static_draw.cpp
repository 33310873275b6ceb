#include <algorithm>

#include "gpu/barrier.h"
#include "render/renderer_state.h"
#include "render/static_tubes.h"

// What drawing takes where all tubes' vertices are kept, against which templates are measured.
namespace vasa {
using namespace stage;

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

}  // namespace vasa
