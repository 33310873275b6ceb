#include "surface/fork_stump.h"

#include <doctest/doctest.h>

#include <random>

#include "support/manifold.h"
#include "support/networks.h"
#include "surface/fork_check.h"
#include "surface/fork_template.h"
#include "surface/surface_mesh.h"

using namespace vasa;

namespace {

// A network whose points were thrown about by a share of their vessel's reach.
struct Thrown {
  Thrown(const Network& network, float share, std::uint32_t seed)
      : table(makeSweepTable(network)), frames(network.sectionCount()) {
    points.assign(network.points().begin(), network.points().end());
    std::mt19937 random(seed);
    const auto signedShare = [&] { return share * (2 * float(random() % 4096) / 4095 - 1); };
    for (vec4& p : points) p += vec4{signedShare(), signedShare(), signedShare(), 0};
    pinEnds(network, points);
    networkFrames(network, points, restReferences(network), frames);
  }
  PosedNetwork posed() const { return {table, points, frames}; }

  SweepTable table;
  std::vector<vec4> points;
  std::vector<quat> frames;
};

std::uint32_t foldsOf(const PosedNetwork& posed, const ForkShape& shape, const shared::ForkRecord& fork) {
  std::vector<SurfacePoint> points(shape.vertices());
  const ForkLayout layout = evaluateFork(posed, fork, shape, points);
  std::uint32_t count = 0;
  for (const uvec3& t : forkTriangles(shape, layout, points))
    count += folds(points[t.x], points[t.y], points[t.z]);
  return count;
}

}  // namespace

TEST_CASE("a stump's tip lies where it is wanted, or half a radius deep") {
  Stump stump;
  stump.ring.centre = {1, 0, 0};
  stump.ring.radius = 0.2f;
  stump.inward = {0, 0, 1};
  stump.towards = {2, 0, 3};
  CHECK(stump.tip() == vec3(2, 0, 3));
  stump.towards = {2, 0, -3};
  CHECK(glm::distance(stump.tip(), vec3(2, 0, 0.1f)) < 1e-6f);
}

TEST_CASE(
    "however a network is thrown about, no triangle of its forks looks the wrong way, and its surface is closed") {
  const Network network = test::branchingNetwork(41, 6);
  std::uint32_t open = 0;
  for (const float share : {0.005f, 0.02f, 0.1f}) {
    const Thrown thrown(network, share, 3);
    for (const shared::ForkRecord& fork : thrown.table.forks) {
      open += foldedUnsmoothed(thrown.posed(), fork, 8);
      for (std::uint32_t a = 3; a <= 16; ++a)
        for (const std::uint32_t b : {3u, 5u, 8u, 16u}) {
          const ForkShape shape{a, b, fork.branchCount, {b, a}};
          CHECK(foldsOf(thrown.posed(), shape, fork) == 0);
        }
    }
    for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{8, 5}, SweepShape{16, 3}})
      CHECK(test::openEdges(surfaceMesh(thrown.posed(), shape).triangles) == 0);
  }
  CHECK(open > 100);  // or nothing was tried
}
