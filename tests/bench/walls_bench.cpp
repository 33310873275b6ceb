// What a clip does to the walls kept around forks: on how many of them triangles look against their normals,
// as their rings carry them and as they are drawn, and the worst wall's share of area that does.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "scene/frame.h"
#include "surface/fork_check.h"
#include "surface/patch_smooth.h"
#include "taken.h"

using namespace vasa;

namespace {

constexpr const char* kUsage = "usage: bench_walls BODY.glb NETWORK.vasa CLIP [EVERY]\n";
constexpr std::uint32_t kAround = 8;  // carries nothing

struct Folds {
  std::size_t any = 0, hundredth = 0, twentieth = 0;
  float worst = 0;

  void add(float share) {
    any += share > 0;
    hundredth += share > 0.01f;
    twentieth += share > 0.05f;
    worst = std::max(worst, share);
  }
  void print(const char* how) const {
    std::printf("%s: %zu fold, %zu by over 1 %% of their area, %zu by over 5 %%, at worst %.1f %%\n", how,
                any, hundredth, twentieth, 100 * worst);
  }
};

float foldedShare(const PatchTable& table, const PatchTable::Patch& patch,
                  std::span<const SurfacePoint> points) {
  double folded = 0, all = 0;
  for (std::uint32_t i = patch.firstTriangle; i < patch.firstTriangle + patch.triangleCount; ++i) {
    const uvec3 t = table.triangles[i] - patch.firstVertex;
    const SurfacePoint &a = points[t.x], &b = points[t.y], &c = points[t.z];
    const double area = glm::length(glm::cross(b.position - a.position, c.position - a.position));
    all += area;
    if (folds(a, b, c)) folded += area;
  }
  return all > 0 ? float(folded / all) : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs(kUsage, stderr), 2;
  const Scene scene = taken(loadScene({.body = argv[1], .networks = {argv[2]}}));
  const Clip* const clip = taken(findClip(scene.body, argv[3]));
  const std::uint32_t every = argc > 4 ? std::uint32_t(std::max(1, std::atoi(argv[4]))) : 1;
  const SweepTable sweeps = makeSweepTable(scene.network);
  const PatchTable& table = sweeps.patches;
  FrameMaker maker(scene, {.avoid = true});
  Folds carried, drawn;
  std::size_t walls = 0, strained = 0;
  for (std::uint32_t frame = 0; frame < clip->frameCount(); frame += every) {
    maker.make(clip, clip->timeOfFrame(frame));
    const PosedNetwork posed{sweeps, maker.points(), maker.knotFrames()};
    std::vector<shared::JointRows> seams;
    for (std::uint32_t i = 0; i < table.seams.size(); ++i) seams.push_back(poseSeam(posed, i, kAround).joint);
    for (const PatchTable::Patch& patch : table.patches) {
      std::vector<SurfacePoint> points;
      for (std::uint32_t i = 0; i < patch.vertexCount; ++i)
        points.push_back(poseVertex(table.vertices[patch.firstVertex + i], seams));
      carried.add(foldedShare(table, patch, points));
      const float share = patchSmoothing(table, patch, seams);
      if (share > 0) smoothPatch(table, patch, share, points);
      drawn.add(foldedShare(table, patch, points));
      strained += share > 0;
      ++walls;
    }
  }
  std::printf("%zu walls, frame by frame: %zu strained and smoothed\n", walls, strained);
  carried.print("carried");
  drawn.print("drawn");
}
