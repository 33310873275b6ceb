#include "body/motion_units.h"

#include <doctest/doctest.h>

#include "body/doll.h"
#include "body/retarget.h"
#include "io/bvh.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr int kWalked = 96;

// As files are read, in one unit.
Motion doll(const DollDialect& dialect) {
  auto motion = parseBvh(dollMotion(dialect, kWalked), "doll.bvh");
  REQUIRE(motion.ok());
  return std::move(*motion);
}

MotionUnits unitsIn(const Motion& motion) { return motionUnits(motion, partsOf(motion).of); }

vec3 wayOfHips(const Motion& motion) {
  const Body body = dollBody("cmu");
  const auto done = retargeted(motion, body);
  if (!done.ok()) FAIL(done.error().message);
  const Pose first = samplePose(body.skeleton, done->clip, 0),
             last = samplePose(body.skeleton, done->clip, done->clip.end);
  return vec3(last.world[0][3] - first.world[0][3]);
}

}  // namespace

TEST_CASE("a root that moves in another unit than the skeleton's goes as far as the feet say") {
  const vec3 way = wayOfHips(doll({.family = "cmu", .glides = 0}));
  REQUIRE(glm::length(way) > 0.1f);
  for (const bool zUp : {false, true})
    for (const double unit : {1.0, 100.0})
      for (const double times : {0.01, 0.0254, 0.1, 10.0, 100.0, 1000.0, 1 / 170.0}) {
        const Motion motion =
            doll({.family = "cmu", .unitsAMetre = unit, .zUp = zUp, .glides = 0, .rootTimes = times});
        CHECK(glm::distance(wayOfHips(motion), way) < 0.02f * glm::length(way));
      }
  MotionUnits units;
  units.places = 100;
  CHECK(describeUnits(units).starts_with(
      "its root moves in another unit than its OFFSETs: the way is taken 100 times as long"));
}

TEST_CASE("what feet do not tell, or tell of one unit, is left as it is") {
  const auto way = [](const DollDialect& dialect) {
    const Motion motion = doll(dialect);
    return motion.translation(motion.frameCount - 1, 0) - motion.translation(0, 0);
  };
  CHECK(glm::distance(way({.family = "cmu"}), vec3(0.02f, 0, 0.03f) * float(kWalked - 1)) < 1e-3f);
  const vec3 somewhat = way({.family = "cmu", .unitsAMetre = 10, .glides = 0.3f}),
             whole = way({.family = "cmu", .unitsAMetre = 10, .glides = 0});
  CHECK(glm::distance(somewhat, 0.7f * whole) < 1e-3f * glm::length(whole));
  CHECK(way({.family = "cmu", .glides = 1}) == vec3(0));
  Motion driven = doll({.family = "cmu", .glides = 1});  // walks on the spot, on something that drives
  for (std::size_t frame = 0; frame < driven.frameCount; ++frame)
    driven.translations[frame * driven.joints.size()] = vec3(0, 0.95f, 0.3f * float(frame));
  CHECK(unitsIn(driven).one());
}

TEST_CASE("offsets that make another one's legs than the frames do are brought to these") {
  Motion motion = doll({.family = "cmu", .glides = 0});
  const vec3 way = wayOfHips(motion);
  for (Motion::Joint& joint : motion.joints) {
    joint.moves = true;
    joint.offset *= 100;
  }
  CHECK(std::abs(unitsIn(motion).offsets * 100 - 1) < 0.01f);
  CHECK(glm::distance(wayOfHips(inOneUnit(motion, unitsIn(motion))), way) < 0.02f * glm::length(way));
}
