#include "surface/patch_smooth.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "convert/forked_source.h"
#include "support/frames.h"
#include "support/manifold.h"
#include "surface/fork_check.h"
#include "surface/surface_mesh.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct Walls {
  explicit Walls(const Network& drawn) : network(drawn), table(makeSweepTable(drawn)) {}

  std::vector<shared::JointRows> joints(std::span<const vec4> points) const {
    const std::vector<quat> frames = framesOf(network, points);
    const PosedNetwork posed{table, points, frames};
    std::vector<shared::JointRows> found;
    for (std::uint32_t seam = 0; seam < table.patches.seams.size(); ++seam)
      found.push_back(poseSeam(posed, seam, 8).joint);
    return found;
  }

  std::vector<SurfacePoint> unsmoothed(const PatchTable::Patch& patch,
                                       std::span<const shared::JointRows> seams) const {
    std::vector<SurfacePoint> points;
    for (std::uint32_t i = 0; i < patch.vertexCount; ++i)
      points.push_back(poseVertex(table.patches.vertices[patch.firstVertex + i], seams));
    return points;
  }

  float foldedShare(const PatchTable::Patch& patch, std::span<const SurfacePoint> points) const {
    float folded = 0, all = 0;
    for (std::uint32_t i = 0; i < patch.triangleCount; ++i) {
      const uvec3 t = table.patches.triangles[patch.firstTriangle + i] - patch.firstVertex;
      const float area = glm::length(glm::cross(points[t.y].position - points[t.x].position,
                                                points[t.z].position - points[t.x].position));
      all += area;
      if (folds(points[t.x], points[t.y], points[t.z])) folded += area;
    }
    return folded / all;
  }

  const Network& network;
  SweepTable table;
};

bool same(const SurfacePoint& a, const SurfacePoint& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("a fan is the triangles around a vertex, in their order; vertices on loops have none") {
  const Forked& made = forked();
  const PatchTable table = makeSweepTable(made.network).patches;
  REQUIRE(table.patches.size() == 2);
  CHECK(table.firstFan.size() == table.vertices.size() + 1);
  CHECK(table.firstFan.back() == table.fans.size());
  for (const PatchTable::Patch& patch : table.patches) {
    std::uint32_t onLoops = 0;
    for (std::uint32_t s = 0; s < patch.seamCount; ++s) onLoops += table.seams[patch.firstSeam + s].loopCount;
    std::vector<std::vector<std::uint32_t>> wanted(patch.vertexCount);
    for (std::uint32_t i = 0; i < patch.triangleCount; ++i) {
      const uvec3 t = table.triangles[patch.firstTriangle + i] - patch.firstVertex;
      for (int k = 0; k < 3; ++k)
        if (t[k] >= onLoops) wanted[t[k]].push_back(t[(k + 1) % 3] | t[(k + 2) % 3] << 16);
    }
    for (std::uint32_t v = 0; v < patch.vertexCount; ++v) {
      std::vector<std::uint32_t> found;
      for (std::uint32_t i = table.firstFan[patch.firstVertex + v];
           i < table.firstFan[patch.firstVertex + v + 1]; ++i) {
        found.push_back(table.fans[i].corners);
        CHECK(table.fans[i].perArea > 0);
      }
      CHECK(found == wanted[v]);
    }
  }
}

TEST_CASE("walls at rest, moved as a whole or bent a little are as their rings carry them, bit for bit") {
  const Forked& made = forked();
  const Walls walls(made.network);
  std::vector<vec4> turned(made.network.points().begin(), made.network.points().end());
  for (vec4& p : turned) p = vec4(p.z + 0.3f, p.y - 1, -p.x, p.w);
  for (const std::vector<vec4>& points : {deepBend(made.network, 0), turned, deepBend(made.network, 2)}) {
    const auto joints = walls.joints(points);
    for (const PatchTable::Patch& patch : walls.table.patches.patches) {
      CHECK(patchSmoothing(walls.table.patches, patch, joints) == 0);
      CHECK(std::ranges::equal(posePatch(walls.table.patches, patch, joints), walls.unsmoothed(patch, joints),
                               same));
    }
  }
}

TEST_CASE("a wall that a pose presses together folds less when it is smoothed, and stays closed") {
  const Forked& made = forked();
  const Walls walls(made.network);
  float before = 0, after = 0;
  for (const float bend : {80.0f, 110.0f, 140.0f}) {
    const std::vector<vec4> points = deepBend(made.network, bend);
    const auto joints = walls.joints(points);
    for (const PatchTable::Patch& patch : walls.table.patches.patches) {
      before += walls.foldedShare(patch, walls.unsmoothed(patch, joints));
      after += walls.foldedShare(patch, posePatch(walls.table.patches, patch, joints));
    }
    const std::vector<quat> frames = framesOf(made.network, points);
    for (const std::uint32_t around : {3u, 8u, 16u})
      CHECK(openEdges(surfaceMesh(made.network, points, frames, {around, 3}).triangles) == 0);
  }
  MESSAGE("share of folded area: " << before / 6 << ", smoothed " << after / 6);
  CHECK(before > 0.01f);
  CHECK(after < 0.25f * before);
}

TEST_CASE("smoothing sets in gradually as a bend grows") {
  const Forked& made = forked();
  const Walls walls(made.network);
  const PatchTable& table = walls.table.patches;
  std::vector<std::vector<SurfacePoint>> last;
  std::vector<float> shares;
  float farthest = 0;
  for (float bend = 0; bend < 80; bend += 0.5f) {
    const auto joints = walls.joints(deepBend(made.network, bend));
    std::vector<std::vector<SurfacePoint>> posed;
    for (const PatchTable::Patch& patch : table.patches) {
      shares.push_back(patchSmoothing(table, patch, joints));
      posed.push_back(posePatch(table, patch, joints));
    }
    for (std::size_t p = 0; p < last.size(); ++p)
      for (std::size_t v = 0; v < last[p].size(); ++v)
        farthest = std::max(farthest, glm::distance(last[p][v].position, posed[p][v].position));
    last = std::move(posed);
  }
  const auto [least, most] = std::ranges::minmax(shares);
  CHECK(least == 0);
  CHECK(most == 1);
  CHECK(std::ranges::any_of(shares, [](float s) { return s > 0.05f && s < 0.95f; }));
  MESSAGE("farthest step " << 1000 * farthest << " mm");
  CHECK(farthest < 0.003f);
}
