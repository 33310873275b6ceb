#include "body/joint_motion.h"

#include <doctest/doctest.h>

#include "math/direction.h"

using namespace vasa;

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

namespace {

// A left leg that hangs down: hip, knee, ankle, and toes in front.
Skeleton leg() {
  Skeleton skeleton;
  const vec3 places[] = {{0.1f, 0.9f, 0}, {0.1f, 0.5f, 0}, {0.1f, 0.1f, 0}, {0.1f, 0.05f, 0.15f}};
  for (int j = 0; j < 4; ++j) {
    Skeleton::Joint joint;
    if (j > 0) joint.parent = JointId{std::uint32_t(j - 1)};
    joint.restWorld =
        glm::mat4_cast(glm::angleAxis(0.7f * float(j), vec3(0, 0.6f, 0.8f)));  // a rig's axes are anyhow
    joint.restWorld[3] = vec4(places[j], 1);
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

vec3 ankleAt(const Skeleton& skeleton, JointId joint, const JointMotion& motion, vec3 angles) {
  const JointTurn turn{joint, angles, motion.axes};
  return vec3(turned(skeleton, restPose(skeleton), {&turn, 1}).world[2][3]);
}

}  // namespace

TEST_CASE("joints bend forwards, spread outwards and twist about their length, whatever a rig's axes are") {
  const Skeleton skeleton = leg();
  const vec3 rest(skeleton.joints[2].restWorld[3]);
  const JointMotion hip = jointMotion(skeleton, {0}, "leftUpperLeg"),
                    knee = jointMotion(skeleton, {1}, "leftLowerLeg");
  CHECK(ankleAt(skeleton, {0}, hip, {0.3f, 0, 0}).z > rest.z + 0.2f);
  CHECK(ankleAt(skeleton, {1}, knee, {-0.3f, 0, 0}).z < rest.z - 0.1f);
  CHECK(ankleAt(skeleton, {0}, hip, {0, -0.3f, 0}).x > rest.x + 0.2f);  // the body's left is +X
  CHECK(glm::distance(ankleAt(skeleton, {0}, hip, {0, 0, 0.5f}), rest) < 1e-5f);
}

TEST_CASE("each axis has its own range") {
  const Skeleton skeleton = leg();
  const JointMotion hip = jointMotion(skeleton, {0}, "leftUpperLeg"),
                    other = jointMotion(skeleton, {0}, "rightUpperLeg");
  const JointMotion knee = jointMotion(skeleton, {1}, "leftLowerLeg"),
                    unknown = jointMotion(skeleton, {1}, "");
  CHECK(knee.most.x < glm::radians(10.0f));
  CHECK(knee.least.x < glm::radians(-120.0f));
  CHECK(hip.most.y == -other.least.y);
  CHECK(unknown.most == vec3(kPi / 2));
  CHECK(knee.within({1, 1, 1}) == knee.most);
  CHECK(knee.within({-0.5f, 0, 0}) == vec3(-0.5f, 0, 0));
}

TEST_CASE("a turn about an axis of the world is one about the joint's own axes, within its range") {
  const Skeleton skeleton = leg();
  const JointMotion hip = jointMotion(skeleton, {0}, "leftUpperLeg");
  const mat4 world = skeleton.joints[0].restWorld;
  // Hanging down, it goes forwards.
  const vec3 angles = turnedFurther({0, 0, 0}, hip, world, {-1, 0, 0}, 0.4f);
  CHECK(glm::distance(angles, vec3(0.4f, 0, 0)) < 1e-5f);
  CHECK(glm::distance(turnedFurther({0.3f, -0.2f, 0.5f}, hip, world, {0, 1, 0}, 0), vec3(0.3f, -0.2f, 0.5f)) <
        1e-5f);
  CHECK(turnedFurther({0, 0, 0}, hip, world, {-1, 0, 0}, -1).x == doctest::Approx(hip.least.x));
}

TEST_CASE("bend, spread and twist are found again in the turn that they make, also past a right angle") {
  for (const vec3 angles :
       {vec3(0), vec3(2.5f, 0, 0), vec3(0.4f, -1.9f, 1.2f), vec3(-1, 1, -3), vec3(0, 0, 2)})
    CHECK(glm::distance(anglesOfTurn(turnByAngles(angles)), angles) < 1e-5f);
}

TEST_CASE("what is turned is turned back, and a joint's angles since rest count clip and hand together") {
  const Skeleton skeleton = leg();
  const JointMotion hip = jointMotion(skeleton, {0}, "leftUpperLeg"),
                    knee = jointMotion(skeleton, {1}, "leftLowerLeg");
  Skeleton local = skeleton;  // whose local transforms say what the world's do
  for (std::size_t j = 0; j < local.joints.size(); ++j) {
    const mat4 before = j ? local.joints[j - 1].restWorld : mat4(1);
    local.joints[j].rest.rotation = glm::inverse(rotationOf(before)) * rotationOf(local.joints[j].restWorld);
  }
  const JointTurn clip[]{{{0}, {0.3f, -0.2f, 0.1f}, hip.axes}}, hand[]{{{1}, {-0.7f, 0, 0}, knee.axes}};
  const Pose moved = turned(local, restPose(local), clip), posed = turned(local, moved, hand);
  const Pose back = unturned(local, posed, hand);
  for (std::size_t j = 0; j < local.joints.size(); ++j)
    CHECK(glm::distance(vec3(back.world[j][3]), vec3(moved.world[j][3])) < 1e-6f);
  CHECK(glm::distance(anglesSinceRest(local.joints[0], hip, mat4(1), posed.world[0]), clip[0].angles) <
        1e-5f);
  CHECK(glm::distance(anglesSinceRest(local.joints[1], knee, posed.world[0], posed.world[1]),
                      hand[0].angles) < 1e-5f);
}

TEST_CASE("a joint that is moved takes along what hangs on it, and turned back all are where they were") {
  const Skeleton skeleton = leg();
  const JointMotion hip = jointMotion(skeleton, {0}, "leftUpperLeg"),
                    knee = jointMotion(skeleton, {1}, "leftLowerLeg");
  const vec3 way(0.1f, -0.3f, 0.05f);
  const JointTurn turns[]{{{0}, {0.3f, -0.2f, 0.1f}, hip.axes, way}, {{1}, {-0.7f, 0, 0}, knee.axes}};
  JointTurn still[]{turns[0], turns[1]};
  still[0].moved = vec3(0);
  const Pose rest = restPose(skeleton), moved = turned(skeleton, rest, turns),
             there = turned(skeleton, rest, still), back = unturned(skeleton, moved, turns);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    CHECK(glm::distance(vec3(moved.world[j][3]), vec3(there.world[j][3]) + way) < 1e-6f);
    CHECK(glm::distance(vec3(back.world[j][3]), vec3(rest.world[j][3])) < 1e-6f);
  }
}

TEST_CASE("mirrored angles take the other side's joint to the mirrored place") {
  Skeleton both;
  for (const float side : {1.0f, -1.0f})
    for (int j = 0; j < 2; ++j) {
      Skeleton::Joint joint;
      if (j) joint.parent = {std::uint32_t(both.joints.size() - 1)};
      joint.restWorld[3] = vec4(side * (0.2f + 0.1f * float(j)), 1.4f - 0.3f * float(j), 0, 1);
      both.joints.push_back(joint);
    }
  const vec3 angles(0.5f, -0.8f, 0.4f);
  const JointTurn turns[]{{{0}, angles, jointMotion(both, {0}, "leftUpperArm").axes},
                          {{2}, mirroredAngles(angles), jointMotion(both, {2}, "rightUpperArm").axes}};
  const Pose pose = turned(both, restPose(both), turns);
  CHECK(glm::distance(vec3(pose.world[1][3]), vec3(-1, 1, 1) * vec3(pose.world[3][3])) < 1e-5f);
}
