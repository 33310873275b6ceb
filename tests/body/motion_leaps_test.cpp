#include "body/motion_leaps.h"

#include <doctest/doctest.h>

#include "body/doll.h"
#include "body/rig.h"
#include "io/bvh.h"

using namespace vasa;
using namespace vasa::test;

namespace {

std::vector<std::uint32_t> leapsIn(const Motion& motion) { return leapsOf(motion, rigOf(motion).parts.of); }

}  // namespace

TEST_CASE("frames to which nobody gets from the ones before are found, in any unit") {
  for (const double unit : {1.0, 100.0}) {
    const auto read = parseBvh(dollMotion({.family = "cmu", .unitsAMetre = unit}, 60), "doll.bvh");
    REQUIRE(read.ok());
    CHECK(leapsIn(*read).empty());
    const std::size_t joints = read->joints.size();
    // A tracker that loses its person writes zeros.
    Motion lost = *read;
    for (std::size_t j = 0; j < joints; ++j) lost.translations[30 * joints + j] += vec3(0, float(-unit), 0);
    CHECK(leapsIn(lost) == std::vector<std::uint32_t>{30, 31});
    // One joint that flips.
    Motion flipped = *read;
    for (std::size_t j = 0; j < joints; ++j)
      if (rigOf(*read).parts.of[j] == "leftUpperLeg")
        flipped.rotations[40 * joints + j] *= glm::angleAxis(3.0f, vec3(1, 0, 0));
    CHECK(leapsIn(flipped) == std::vector<std::uint32_t>{40, 41});
    // In five frames a second a limb may turn so far.
    flipped.framesPerSecond = 5;
    CHECK(leapsIn(flipped).empty());
  }
}
