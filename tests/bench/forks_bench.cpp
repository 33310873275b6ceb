// What a clip does to a network's forks: how many fold and are smoothed, how many of these become stumps, and
// how often one becomes a stump or is one no longer from one frame to the next. All forks count, those with
// walls of the source too.
#include <cstdio>
#include <cstdlib>

#include "core/clock.h"
#include "scene/frame.h"
#include "surface/fork_check.h"
#include "surface/fork_plan.h"
#include "taken.h"

using namespace vasa;

namespace {

constexpr const char* kUsage = "usage: bench_forks BODY.glb NETWORK.vasa CLIP [EVERY [AROUND...]]\n";

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs(kUsage, stderr), 2;
  const Scene scene = taken(loadScene({.body = argv[1], .networks = {argv[2]}}));
  const Clip* const clip = taken(findClip(scene.body, argv[3]));
  const std::uint32_t every = argc > 4 ? std::uint32_t(std::max(1, std::atoi(argv[4]))) : 1;
  std::vector<std::uint32_t> arounds;
  for (int k = 5; k < argc; ++k) arounds.push_back(std::uint32_t(std::atoi(argv[k])));
  if (arounds.empty()) arounds = {4, 8, 16};
  const Clock::time_point start = Clock::now();
  ForkPlan plan = planForks(scene.network);
  std::printf("planned in %.0f ms: %u branches, %u forked, %u crowded, %u folded at rest\n", msSince(start),
              plan.report.branches, plan.report.forked, plan.report.crowded, plan.report.folded);
  const SweepTable table = makeSweepTable(scene.network, std::move(plan));
  struct Count {
    std::size_t folds = 0, stumps = 0, switches = 0;
    std::vector<bool> was;
  };
  std::vector<Count> counts(arounds.size());
  FrameMaker maker(scene, {.avoid = true});
  std::size_t frames = 0;
  for (std::uint32_t frame = 0; frame < clip->frameCount(); frame += every, ++frames) {
    maker.make(clip, clip->timeOfFrame(frame));
    const PosedNetwork posed{table, maker.points(), maker.knotFrames()};
    for (std::size_t k = 0; k < arounds.size(); ++k) {
      Count& count = counts[k];
      std::vector<bool> stumps;
      for (const shared::ForkRecord& fork : table.forks) {
        const bool folds = foldedUnsmoothed(posed, fork, arounds[k]) > 0;
        stumps.push_back(folds && isStump(posed, fork, arounds[k]));
        count.folds += folds;
        count.stumps += stumps.back();
        count.switches += !count.was.empty() && count.was[stumps.size() - 1] != stumps.back();
      }
      count.was = std::move(stumps);
    }
  }
  const double all = double(frames * table.forks.size());
  for (std::size_t k = 0; k < arounds.size(); ++k)
    std::printf("%2u around: %.3f %% fold, %.3f %% stumps, %zu switches of %.0f fork-frames\n", arounds[k],
                100 * double(counts[k].folds) / all, 100 * double(counts[k].stumps) / all, counts[k].switches,
                all);
}
