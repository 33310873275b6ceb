#include "viewer/mannequin.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "io/gltf.h"
#include "math/direction.h"
#include "viewer/human_data.h"
#include "viewer/joint_names.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

const Skeleton& human() {
  static const Skeleton skeleton = [] {
    auto body = readBody(test::kData / "human.glb");
    REQUIRE_MESSAGE(body, (body ? "" : body.error().message));
    return body->skeleton;
  }();
  return skeleton;
}

const Mannequin& mannequin() {
  static const Mannequin made = [] {
    const auto ranges = readJointRanges(test::kData / "realism" / "ranges.csv");
    REQUIRE_MESSAGE(ranges, (ranges ? "" : ranges.error().message));
    return Mannequin(human(), *ranges);
  }();
  return made;
}

const Grip* gripNamed(std::string_view name) {
  const auto found = std::ranges::find(mannequin().grips(), name, &Grip::name);
  return found == mannequin().grips().end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("people's joints can be taken hold of; those that only follow can not, and no pull bends them") {
  for (const char* name : {"pelvis", "neck", "head", "left shoulder", "right elbow", "left wrist",
                           "right hip", "left knee", "right ankle", "left toes"})
    CHECK_MESSAGE(gripNamed(name), name);
  const JointId roll = human().find("LeftForeArmRoll"), patella = human().find("LeftPatella"),
                blade = human().find("LeftScapula");
  REQUIRE(roll.valid());
  for (const Grip& grip : mannequin().grips()) {
    CHECK(grip.limb.tip != roll);
    CHECK(grip.limb.tip != patella);
    CHECK(grip.limb.tip != blade);
    for (const ReachJoint& joint : grip.limb.joints) {
      CHECK(joint.joint != patella);
      if (joint.joint == roll) {  // the hand's pull turns it about the forearm, and not otherwise
        CHECK(joint.least.x == joint.most.x);
        CHECK(joint.least.y == joint.most.y);
        CHECK(joint.most.z > 1);
      }
    }
  }
  const Grip* wrist = gripNamed("left wrist");
  REQUIRE(wrist);
  REQUIRE(wrist->limb.joints.size() == 3);
  CHECK(wrist->limb.joints[2].joint == human().find("LeftForeArm"));
}

TEST_CASE("joints go as far as the table says, on both sides") {
  const JointMotion& elbow = mannequin().motion(human().find("LeftForeArm"));
  CHECK(elbow.least.x == 0);
  CHECK(elbow.most.x == doctest::Approx(glm::radians(145.0f)));
  const JointMotion& knee = mannequin().motion(human().find("RightLeg"));
  CHECK(knee.least.x == doctest::Approx(glm::radians(-140.0f)));
  CHECK(knee.most.x == 0);
  const JointMotion &left = mannequin().motion(human().find("LeftArm")),
                    &right = mannequin().motion(human().find("RightArm"));
  CHECK(left.least.y == doctest::Approx(-right.most.y));
  CHECK(left.least.y == doctest::Approx(glm::radians(-120.0f)));  // to the side
  const JointMotion& roll = mannequin().motion(human().find("RightForeArmRoll"));
  CHECK(roll.most.z == doctest::Approx(glm::radians(80.0f)));
}

TEST_CASE("ranges count from hanging arms, also where a body rests with its arms spread") {
  const JointId arm = human().find("LeftArm");
  const JointTurn spread{arm, {0, glm::radians(-77.0f), 0}, mannequin().motion(arm).axes};  // to 90 degrees
  Skeleton raised = human();
  const Pose pose = turned(raised, restPose(raised), {&spread, 1});
  for (std::size_t j = 0; j < raised.joints.size(); ++j) {
    const JointId parent = raised.joints[j].parent;
    const mat4 before = parent.valid() ? pose.world[parent.value] : raised.rootTransform;
    raised.joints[j].restWorld = pose.world[j];
    raised.joints[j].rest.rotation = glm::inverse(rotationOf(before)) * rotationOf(pose.world[j]);
  }
  const auto ranges = readJointRanges(test::kData / "realism" / "ranges.csv");
  REQUIRE(ranges);
  const Mannequin other(raised, *ranges);
  CHECK(std::abs(glm::degrees(other.motion(arm).most.y) - 85) < 2);   // 10 beyond where it hangs
  CHECK(std::abs(glm::degrees(other.motion(arm).least.y) + 45) < 2);  // 120 up from there
  CHECK(other.motion(human().find("RightArm")).most.y == mannequin().motion(human().find("RightArm")).most.y);
}

TEST_CASE("joints are called as people call them, and have a twin") {
  const JointId elbow = human().find("LeftForeArm"), roll = human().find("LeftForeArmRoll"),
                head = human().find("Head");
  CHECK(mannequin().nameOf(elbow) == "left elbow");
  CHECK(mannequin().nameOf(roll) == "left forearm");
  CHECK(mannequin().nameOf(human().find("LeftPatella")) == "LeftPatella");
  CHECK(mannequin().twinOf(elbow) == human().find("RightForeArm"));
  CHECK(mannequin().twinOf(roll) == human().find("RightForeArmRoll"));
  CHECK(mannequin().twinOf(human().find("LeftHandFinger3_2")) == human().find("RightHandFinger3_2"));
  CHECK(mannequin().twinOf(head) == head);
  CHECK(std::string(wordForAxis("leftLowerArm", 0)) == "flexion");
  CHECK(sensesOf("leftLowerLeg").x == -1);
}

TEST_CASE(
    "a pulled wrist takes the arm along; the pose mirrored has the other wrist at the mirrored place, twice mirrored is the same") {
  const ReachLimb& arm = gripNamed("left wrist")->limb;
  const Pose rest = restPose(human());
  const std::vector<vec3> start(arm.joints.size(), vec3(0));
  for (const vec3 target : {vec3(0.25f, 1.35f, 0.35f), vec3(0.6f, 1.5f, 0.2f), vec3(0.1f, 1.2f, 0.3f),
                            vec3(0.25f, 1.85f, 0.1f)}) {
    const Reached there = reach(human(), rest, arm, target, start, start);
    CHECK(there.miss < 1e-3f);
    std::vector<JointTurn> turns;
    for (std::size_t k = 0; k < arm.joints.size(); ++k)
      turns.push_back({arm.joints[k].joint, there.angles[k], arm.joints[k].axes});
    const Pose posed = turned(human(), rest, turns);
    CHECK(glm::distance(vec3(posed.world[arm.tip.value][3]), target) < 1e-3f);
    const auto other = mirroredTurns(mannequin(), turns);
    const Pose mirrored = turned(human(), rest, other);
    const JointId wrist = human().find("RightHand");
    CHECK(glm::distance(vec3(mirrored.world[wrist.value][3]), vec3(-1, 1, 1) * target) < 2e-3f);
    CHECK(mirroredTurns(mannequin(), other) == turns);
  }
}

TEST_CASE("a skeleton that is no person's can be pulled joint by joint") {
  Skeleton row;
  for (int j = 0; j < 3; ++j) {
    Skeleton::Joint joint;
    joint.name = "part" + std::to_string(j);
    if (j > 0) joint.parent = JointId{std::uint32_t(j - 1)};
    joint.restWorld[3] = vec4(float(j), 0, 0, 1);
    joint.rest.translation = {j > 0 ? 1.0f : 0.0f, 0, 0};
    row.joints.push_back(joint);
  }
  const Mannequin plain(row, {});
  REQUIRE(plain.grips().size() == 2);
  CHECK(plain.grips()[1].name == "part2");
  CHECK(plain.grips()[1].limb.joints.front().joint == JointId{1});
}

TEST_CASE("finger joints have people's names") {
  const auto name = [](const char* joint) { return mannequin().nameOf(human().find(joint)); };
  CHECK(name("LeftHandFinger1") == "left index finger, knuckle");
  CHECK(name("LeftHandFinger1_2") == "left index finger, middle joint");
  CHECK(name("RightHandFinger4_3") == "right little finger, end joint");
  CHECK(name("RThumb") == "right thumb, base joint");
  CHECK(gripNamed("left ring finger, tip"));
}
