#include "viewer/posing.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("a turned joint takes along what hangs on it") {
  Skeleton skeleton;
  for (int j = 0; j < 3; ++j) {
    Skeleton::Joint joint;
    if (j > 0) joint.parent = JointId{std::uint32_t(j - 1)};
    joint.restWorld[3] = vec4(float(j), 0, 0, 1);
    joint.rest.translation = {j > 0 ? 1.0f : 0.0f, 0, 0};
    skeleton.joints.push_back(joint);
  }
  const Pose rest = restPose(skeleton);
  const JointTurn turn{JointId{1}, {0, 0, kPi / 2}};
  const Pose pose = turned(skeleton, rest, {&turn, 1});
  CHECK(glm::distance(vec3(pose.world[1][3]), vec3(1, 0, 0)) < 1e-6f);
  CHECK(glm::distance(vec3(pose.world[2][3]), vec3(1, 1, 0)) < 1e-6f);
}

TEST_CASE("turns are cut off at the joint's limit, whichever way they go") {
  CHECK(mostTurn("leftLowerLeg") > mostTurn("leftHand"));
  CHECK(mostTurn("") == doctest::Approx(kPi / 2));
  CHECK(withinLimit({0.2f, 0.1f, 0}, 1) == vec3(0.2f, 0.1f, 0));
  const vec3 cut = withinLimit({2, 0, 0}, 1);
  CHECK(glm::distance(cut, vec3(1, 0, 0)) < 1e-5f);
}

TEST_CASE("a turn about an axis of the world is one in the joint's own axes") {
  mat4 world = glm::mat4_cast(glm::angleAxis(kPi / 2, vec3(1, 0, 0)));  // its y points to +Z
  const vec3 angles = turnedFurther({0, 0, 0}, world, {0, 0, 1}, 0.4f, 2);
  CHECK(glm::distance(angles, vec3(0, 0.4f, 0)) < 1e-5f);
  const vec3 more = turnedFurther({0.3f, -0.2f, 0.5f}, mat4(1), {0, 1, 0}, 0, 3);
  CHECK(glm::distance(more, vec3(0.3f, -0.2f, 0.5f)) < 1e-5f);  // angles and back
  CHECK(glm::length(turnedFurther({0, 0, 0}, mat4(1), {0, 0, 1}, 3, 0.5f)) == doctest::Approx(0.5));
}
