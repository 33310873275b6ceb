#include <doctest/doctest.h>

#include "drawn_surface.h"
#include "real_poses.h"
#include "support/frames.h"
#include "support/networks.h"
#include "support/shared_data.h"
#include "surface/fork_check.h"

// What the device draws, read back: tubes, caps, forks and patches make closed surfaces, in which vertices
// are one where their positions are the same bits.

using namespace vasa;

TEST_CASE("the drawn surface of branching networks is closed, at fixed and at automatic quads") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(71, 12);
  const std::vector<vec4> points(network.points().begin(), network.points().end());
  const std::vector<quat> frames = test::framesOf(network, points);
  for (const TubeDetail& detail :
       {TubeDetail{{3, 2}, 0}, TubeDetail{{8, 5}, 0}, TubeDetail{{16, 20}, 0}, TubeDetail{{}, 0.02f}}) {
    CAPTURE(detail.shape.around);
    CHECK(test::openEdgesDrawn({rig, network, points, frames, detail}) == 0);
  }
}

TEST_CASE("a real body's drawn surface is closed in three poses, and its forks do not fold in its motions") {
  VASA_REQUIRE_GPU(rig);
  VASA_REQUIRE_SHARED_DATA(data);
  const Result<test::RealPoses> real = test::realPoses(data, {"elbow_flex", "knee_squat", "fist"}, 12);
  REQUIRE(real.ok());
  const SweepTable table = makeSweepTable(real->network);
  std::size_t forks = 0, folded = 0, triangles = 0, stumps = 0;
  for (const test::RealPoses::Pose& pose : real->poses) {
    for (const shared::ForkRecord& fork : table.forks) {
      const std::uint32_t folds = foldedTriangles({table, pose.points, pose.knotFrames}, fork, 8, nullptr);
      triangles += folds;
      folded += folds > 0;
      stumps += isStump({table, pose.points, pose.knotFrames}, fork, 8);
      ++forks;
    }
    if (pose.middle && pose.clip != "fist")
      CHECK(test::openEdgesDrawn({rig, real->network, pose.points, pose.knotFrames, {{8, 5}, 0}}) == 0);
  }
  MESSAGE(folded << " of " << forks << " forks in " << real->poses.size() << " frames fold somewhere, in "
                 << triangles << " triangles; " << stumps << " have stumps");
  CHECK(folded == 0);
  CHECK(1000 * stumps < forks);
}
