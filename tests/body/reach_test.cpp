#include "body/reach.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "body/joint_motion.h"
#include "math/direction.h"

using namespace vasa;

namespace {

struct LimbRig {
  Skeleton skeleton;
  ReachLimb limb;
  std::vector<vec3> rest() const { return std::vector<vec3>(limb.joints.size(), vec3(0)); }
};

// A left arm that hangs down, as the built-in human's: collar bone, shoulder, elbow, a roll joint in
// mid-forearm that only follows, wrist. The rig's axes are anyhow.
LimbRig leftArm() {
  LimbRig rig;
  const vec3 places[] = {{0.024f, 1.424f, 0.036f},
                         {0.178f, 1.405f, -0.018f},
                         {0.2466f, 1.1083f, -0.034f},
                         {0.2775f, 1.0409f, -0.026f},
                         {0.3298f, 0.8678f, -0.010f}};
  mat4 before(1);
  for (int j = 0; j < 5; ++j) {
    Skeleton::Joint joint;
    joint.name = std::to_string(j);
    if (j > 0) joint.parent = JointId{std::uint32_t(j - 1)};
    joint.restWorld = glm::mat4_cast(glm::angleAxis(0.9f * float(j) + 0.3f, vec3(0, 0.6f, 0.8f)));
    joint.restWorld[3] = vec4(places[j], 1);
    const mat4 local = glm::inverse(before) * joint.restWorld;
    joint.rest = {vec3(local[3]), rotationOf(local), vec3(1)};
    before = joint.restWorld;
    rig.skeleton.joints.push_back(joint);
  }
  const auto add = [&](std::uint32_t joint, const char* part, vec3 least, vec3 most, float stiffness) {
    rig.limb.joints.push_back({{joint},
                               jointMotion(rig.skeleton, {joint}, part).axes,
                               glm::radians(least),
                               glm::radians(most),
                               stiffness});
  };
  add(0, "leftShoulder", {-10, -30, 0}, {15, 10, 0}, 30);
  add(1, "leftUpperArm", {-60, -120, -90}, {120, 10, 70}, 1);
  add(2, "leftLowerArm", {0, 0, 0}, {145, 0, 0}, 1);
  rig.limb.tip = {4};
  return rig;
}

Reached go(const LimbRig& rig, vec3 target, const std::vector<vec3>& start) {
  return reach(rig.skeleton, restPose(rig.skeleton), rig.limb, target, rig.rest(), start);
}

vec3 endAt(const LimbRig& rig, const std::vector<vec3>& angles) {
  return endOf(rig.skeleton, restPose(rig.skeleton), rig.limb, angles);
}

bool within(const ReachLimb& limb, const std::vector<vec3>& angles) {
  for (std::size_t k = 0; k < angles.size(); ++k)
    if (glm::clamp(angles[k], limb.joints[k].least, limb.joints[k].most) != angles[k]) return false;
  return true;
}

std::vector<vec3> anyAngles(const ReachLimb& limb, std::mt19937& random) {
  std::vector<vec3> angles;
  for (const ReachJoint& joint : limb.joints) {
    vec3 own;
    for (int axis = 0; axis < 3; ++axis)
      own[axis] = glm::mix(joint.least[axis], joint.most[axis], float(random() % 10001) / 10000);
    angles.push_back(own);
  }
  return angles;
}

}  // namespace

TEST_CASE("angles since rest say where a limb's end is, and what hangs between its joints goes along") {
  const LimbRig rig = leftArm();
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const std::vector<vec3> angles = anyAngles(rig.limb, random);
    std::vector<JointTurn> turns;
    for (std::size_t k = 0; k < angles.size(); ++k)
      turns.push_back({rig.limb.joints[k].joint, angles[k], rig.limb.joints[k].axes});
    const Pose pose = turned(rig.skeleton, restPose(rig.skeleton), turns);
    CHECK(glm::distance(endAt(rig, angles), vec3(pose.world[4][3])) < 1e-5f);
  }
}

TEST_CASE("a wrist is taken to every place that its arm can reach, to a millimetre and within the limits") {
  const LimbRig rig = leftArm();
  std::mt19937 random(7);
  int missed = 0;
  float worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const vec3 target = endAt(rig, anyAngles(rig.limb, random));
    const Reached there = go(rig, target, rig.rest());
    REQUIRE(within(rig.limb, there.angles));
    CHECK(glm::distance(endAt(rig, there.angles), there.end) < 1e-5f);
    missed += there.miss > 1e-3f;
    worst = std::max(worst, there.miss);
  }
  MESSAGE(missed << " of 1000 missed, by " << 1000 * worst << " mm at most");
  CHECK(missed == 0);
}

TEST_CASE("what cannot be reached is approached as near as the limits let it") {
  const LimbRig rig = leftArm();
  std::mt19937 random(11);
  std::vector<vec3> ends;
  for (int i = 0; i < 300000; ++i) ends.push_back(endAt(rig, anyAngles(rig.limb, random)));
  for (const vec3 target : {vec3(1.5f, 1.4f, 0.3f), vec3(0.5f, 0.2f, 0.1f), vec3(0.2f, 2.4f, 0.2f),
                            vec3(0.4f, 1.2f, 1.3f), vec3(-0.9f, 1.3f, 0.6f), vec3(0.3f, 1.3f, -0.9f)}) {
    const Reached there = go(rig, target, rig.rest());
    float least = 1e9f;
    for (const vec3 end : ends) least = std::min(least, glm::distance(end, target));
    CAPTURE(target.x);
    CHECK(there.miss > 1e-3f);
    CHECK(there.miss < least + 5e-3f);  // than the best of so many tries
    CHECK(within(rig.limb, there.angles));
  }
}

TEST_CASE("the arm follows a target steadily, in reach and out of it, and comes back to the same pose") {
  const LimbRig rig = leftArm();
  std::vector<vec3> angles = rig.rest();
  vec3 end = endAt(rig, angles);
  float fastest = 0, farthest = 0;
  std::vector<vec3> first;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 1500; ++i) {
      const float a = 2 * kPi * float(i) / 1500;
      const vec3 target =
          vec3(0.35f, 1.15f, 0.25f) + 0.35f * vec3(std::sin(a), -std::cos(a), 0.4f * std::sin(2 * a));
      const Reached there = go(rig, target, angles);
      if (round > 0 || i > 0) {
        for (std::size_t k = 0; k < angles.size(); ++k)
          fastest = std::max(fastest, glm::length(there.angles[k] - angles[k]));
        farthest = std::max(farthest, glm::distance(there.end, end));
      }
      angles = there.angles, end = there.end;
      if (round == 0 && i == 700) first = angles;
      if (round == 1 && i == 700)
        for (std::size_t k = 0; k < angles.size(); ++k) CHECK(glm::distance(first[k], angles[k]) < 2e-3f);
    }
  MESSAGE("1.5 mm of target turn a joint by " << glm::degrees(fastest) << " degrees and move the wrist by "
                                              << 1000 * farthest << " mm at most");
  CHECK(glm::degrees(fastest) < 8);  // where the arm is all but stretched
  CHECK(farthest < 4e-3f);
}

TEST_CASE("the collar bone helps little where the arm alone can reach, and beyond it as far as it can") {
  const LimbRig rig = leftArm();
  const Reached near = go(rig, {0.35f, 1.2f, 0.3f}, rig.rest()),
                far = go(rig, {0.9f, 2.3f, 0.3f}, rig.rest());
  CHECK(near.miss < 1e-4f);
  CHECK(glm::length(near.angles[0]) < glm::radians(3.0f));
  CHECK(far.angles[0].y == doctest::Approx(rig.limb.joints[0].least.y));
  CHECK(far.angles[2].x == 0);  // stretched
}

TEST_CASE("the same question has the same answer, to the last bit") {
  const LimbRig rig = leftArm();
  const vec3 target{0.4f, 1.3f, 0.35f};
  CHECK(go(rig, target, rig.rest()).angles == go(rig, target, rig.rest()).angles);
}
