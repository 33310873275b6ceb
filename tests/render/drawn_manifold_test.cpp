#include <doctest/doctest.h>

#include "drawn_surface.h"
#include "real_poses.h"
#include "support/manifold.h"
#include "support/networks.h"
#include "support/shared_data.h"
#include "surface/fork_check.h"

// What the device draws, read back: tubes, caps and forks make closed surfaces, in which vertices are one where their
// positions are the same bits.

using namespace vasa;

namespace {

void take(const test::Drawn& drawn, std::vector<vec3>& positions, std::vector<uvec3>& triangles) {
  const std::uint32_t base = std::uint32_t(positions.size());
  for (const shared::TubeVertex& v : drawn.vertices) positions.emplace_back(v.x, v.y, v.z);
  for (const shared::DrawCommand& draw : drawn.draws)
    for (std::uint32_t i = 0; i < draw.indexCount; i += 3) {
      const std::uint32_t* index = &drawn.indices[draw.firstIndex + i];
      triangles.push_back(uvec3(index[0], index[1], index[2]) + base);
    }
}

// @return edges that do not belong to exactly two triangles. A cap's pole is a ring of vertices in one place: triangles
//         without area there are left out.
std::size_t openEdgesDrawn(const test::Forks& passes) {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  take(passes.tubesDrawn, positions, triangles);
  take(passes.forksDrawn, positions, triangles);
  std::vector<uvec3> welded = test::weldedByBits(positions, triangles);
  std::erase_if(welded, [](const uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
  return test::openEdges(welded);
}

}  // namespace

TEST_CASE("the drawn surface of branching networks is closed, at fixed and at automatic quads") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(71, 12);
  const std::vector<vec4> points(network.points().begin(), network.points().end());
  std::vector<quat> frames(network.sectionCount());
  networkFrames(network, points, restReferences(network), frames);
  for (const TubeDetail& detail : {TubeDetail{{3, 2}, 0}, TubeDetail{{8, 5}, 0}, TubeDetail{{16, 20}, 0},
                                   TubeDetail{{}, 0.02f}}) {
    CAPTURE(detail.shape.around);
    CHECK(openEdgesDrawn({rig, network, points, frames, detail}) == 0);
  }
}

TEST_CASE("a real body's drawn surface is closed in three poses, and its forks do not fold in its motions") {
  VASA_REQUIRE_GPU(rig);
  VASA_REQUIRE_SHARED_DATA(data);
  const Result<test::RealPoses> real = test::realPoses(data, {"elbow_flex", "knee_squat", "fist"}, 12);
  REQUIRE(real.ok());
  const SweepTable table = makeSweepTable(real->network);
  std::size_t forks = 0, folded = 0, triangles = 0;
  for (const test::RealPoses::Pose& pose : real->poses) {
    for (const shared::ForkRecord& fork : table.forks) {
      const std::uint32_t folds = foldedTriangles({table, pose.points, pose.knotFrames}, fork, 8, ForkForm::fitting);
      triangles += folds;
      folded += folds > 0;
      ++forks;
    }
    if (pose.middle && pose.clip != "fist")
      CHECK(openEdgesDrawn({rig, real->network, pose.points, pose.knotFrames, {{8, 5}, 0}}) == 0);
  }
  MESSAGE(folded << " of " << forks << " forks in " << real->poses.size() << " frames fold somewhere, in " << triangles
                 << " triangles");
  CHECK(folded == 0);
}
