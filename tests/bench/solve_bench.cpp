// Times what the processor does for a frame, without drawing: of each stage the least of some rounds over a
// clip, which says more than a mean on a machine that has other work, averaged over the frames after the
// first.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "core/parallel.h"
#include "render/profiler.h"
#include "scene/frame.h"
#include "taken.h"

using namespace vasa;

namespace {

constexpr const char* kUsage = "usage: bench_solve BODY.glb NETWORK.vasa CLIP [THREADS [ROUNDS [FRAMES]]]\n";

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs(kUsage, stderr), 2;
  setThreadCount(argc > 4 ? unsigned(std::atoi(argv[4])) : 1);
  const int rounds = argc > 5 ? std::atoi(argv[5]) : 10;
  std::filesystem::path holds = std::filesystem::path(argv[2]).replace_extension(".holds.csv");
  if (!std::filesystem::exists(holds)) holds.clear();
  const Scene scene = taken(loadScene({.body = argv[1], .networks = {argv[2]}, .holds = holds}));
  const Clip* const clip = taken(findClip(scene.body, argv[3]));
  const std::uint32_t frames =
      argc > 6 ? std::min(clip->frameCount() - 1, std::uint32_t(std::atoi(argv[6]))) : clip->frameCount() - 1;

  std::map<std::string, std::vector<double>> least;  // of a stage, a frame each
  for (int round = 0; round < rounds; ++round) {
    // A fresh one: what was solved once would be read from the track.
    FrameMaker maker(scene, {.avoid = true});
    maker.make(clip, clip->timeOfFrame(0));
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      maker.make(clip, clip->timeOfFrame(frame + 1));
      for (const auto& [stage, ms] : shapeStages(maker.report(), true)) {
        auto& of = least[stage];
        of.resize(frames, 1e9);
        of[frame] = std::min(of[frame], ms);
      }
    }
  }
  double all = 0;
  for (const auto& [stage, values] : least) {
    double sum = 0;
    for (const double ms : values) sum += ms;
    std::printf("  %-16s %8.3f ms\n", stage.c_str(), sum / frames);
    all += sum / frames;
  }
  std::printf("  %-16s %8.3f ms\n", "together", all);
}
