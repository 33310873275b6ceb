#include "body/idle_joints.h"

#include <doctest/doctest.h>

#include "body/binding.h"
#include "body/chain.h"
#include "body/deform.h"
#include "body/person.h"
#include "body/retarget.h"
#include "body/rig.h"

using namespace vasa;
using namespace vasa::test;

namespace {

vec3 placeOf(const Body& body, const char* joint) {
  return vec3(body.skeleton.joints[body.skeleton.find(joint).value].restWorld[3]);
}

void add(Body& body, const std::string& name, JointId parent, vec3 place) {
  Skeleton::Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.restWorld = glm::translate(mat4(1), place);
  joint.rest.translation =
      parent.valid() ? place - vec3(body.skeleton.joints[parent.value].restWorld[3]) : place;
  joint.inverseBind = glm::inverse(joint.restWorld);
  body.skeleton.joints.push_back(joint);
}

std::vector<std::string> leaveOut(Body& body) {
  return leaveOutIdleJoints(body, std::vector<bool>(body.skeleton.joints.size(), false));
}

}  // namespace

TEST_CASE("handles beside the limbs take no vessels along") {
  Body body = person();
  const std::size_t joints = body.skeleton.joints.size();
  const JointId hips = body.skeleton.find("hips"), elbow = body.skeleton.find("leftLowerArm");
  REQUIRE(elbow.valid());
  const vec3 wrist = placeOf(body, "leftHand");
  add(body, "ik_hand_l", hips, wrist);
  add(body, "ik_foot_l", hips, placeOf(body, "leftFoot"));
  CHECK(leaveOut(body) == std::vector<std::string>{"ik_hand_l", "ik_foot_l"});
  CHECK(body.skeleton.joints.size() == joints);
  // An artery that runs through forearm and hand goes with them.
  const vec3 forearm = wrist - placeOf(body, "leftLowerArm");
  const std::vector<vec4> points = bundle(wrist - 0.7f * forearm, wrist + 0.3f * forearm, {0.01f}, 1, 11);
  const auto bound = bindPoints(body, points, "forearm", {});
  if (!bound.ok()) FAIL(bound.error().message);
  const Pose pose = turned(body, {{elbow.value, glm::angleAxis(1.2f, vec3(0, 0, 1))}});
  std::vector<vec4> moved(points.size());
  Deformer(*bound).run(points, pose, moved);
  const mat4 byElbow = pose.world[elbow.value] * body.skeleton.joints[elbow.value].inverseBind;
  for (std::size_t i = 2; i < points.size(); ++i)
    CHECK(glm::distance(vec3(moved[i]), vec3(byElbow * vec4(vec3(points[i]), 1))) < 0.01f);
}

TEST_CASE("chains of controls in the same places are no person; what ends a limb stays") {
  Body body = person();
  const std::size_t joints = body.skeleton.joints.size();
  Body doubled = body;
  doubled.skeleton.joints.clear();
  // Controls come first in the file, and have the better names.
  for (std::size_t j = 0; j < joints; ++j) doubled.skeleton.joints.push_back(body.skeleton.joints[j]);
  for (std::size_t j = 0; j < joints; ++j) {
    Skeleton::Joint joint = body.skeleton.joints[j];
    if (joint.parent.valid()) joint.parent.value += std::uint32_t(joints);
    joint.name = "DEF-" + joint.name;
    doubled.skeleton.joints.push_back(joint);
  }
  for (SkinnedMesh& mesh : doubled.meshes)
    for (SkinInfluence& influence : mesh.influences)
      for (std::uint16_t& joint : influence.joints) joint = std::uint16_t(joint + joints);
  doubled.clips = {turningClip(std::uint32_t(joints), quat(1, 0, 0, 0))};
  add(doubled, "head_end", {std::uint32_t(joints + body.skeleton.find("head").value)},
      placeOf(body, "head") + vec3(0, 0.1f, 0));
  const std::vector<std::string> gone = leaveOut(doubled);
  CHECK(gone.size() == joints);
  CHECK(gone.front() == body.skeleton.joints[0].name);
  REQUIRE(doubled.skeleton.joints.size() == joints + 1);
  for (std::size_t j = 0; j < joints; ++j) {
    CHECK(doubled.skeleton.joints[j].name == "DEF-" + body.skeleton.joints[j].name);
    CHECK(doubled.skeleton.joints[j].parent == body.skeleton.joints[j].parent);
  }
  CHECK(doubled.skeleton.joints.back().parent == body.skeleton.find("head"));
  CHECK(doubled.clips[0].tracks[0].joint == JointId{0});
  for (std::size_t m = 0; m < body.meshes.size(); ++m)
    for (std::size_t v = 0; v < body.meshes[m].influences.size(); v += 97) {
      const SkinInfluence &was = body.meshes[m].influences[v], &is = doubled.meshes[m].influences[v];
      for (int k = 0; k < 4; ++k)
        if (was.weights[k] > 0) CHECK(is.joints[std::size_t(k)] == was.joints[std::size_t(k)]);
    }
  CHECK(humanoidKeys(partsOf(doubled.skeleton).of) == kHumanoidKeys);
}

TEST_CASE("what is kept, bodies without meshes, and clips that move only what would go") {
  Body body = person();
  const std::size_t joints = body.skeleton.joints.size();
  add(body, "ik_hand_l", body.skeleton.find("hips"), placeOf(body, "leftHand"));
  std::vector<bool> keep(joints + 1, false);
  keep.back() = true;
  CHECK(leaveOutIdleJoints(body, keep).empty());
  body.clips = {turningClip(std::uint32_t(joints), quat(0, 1, 0, 0))};
  CHECK(leaveOut(body).empty());
  body.clips.clear();
  body.meshes.clear();
  CHECK(leaveOut(body).empty());
  CHECK(body.skeleton.joints.size() == joints + 1);
}

TEST_CASE("a skin of a part of a person takes no limbs away") {
  Body body = person();
  const JointId chest = body.skeleton.find("chest");
  REQUIRE(chest.valid());
  const std::size_t joints = body.skeleton.joints.size();
  for (SkinnedMesh& mesh : body.meshes)
    for (SkinInfluence& influence : mesh.influences)
      influence = {{std::uint16_t(chest.value), 0, 0, 0}, vec4(1, 0, 0, 0)};
  CHECK(leaveOut(body).empty());
  CHECK(body.skeleton.joints.size() == joints);
}

TEST_CASE("two people in one file are counted") {
  Skeleton two = person().skeleton;
  CHECK(peopleIn(two) == 1);
  const Skeleton second = two;
  for (Skeleton::Joint joint : second.joints) {
    if (joint.parent.valid()) joint.parent.value += std::uint32_t(second.joints.size());
    joint.restWorld = glm::translate(mat4(1), vec3(1.5f, 0, 0)) * joint.restWorld;
    two.joints.push_back(joint);
  }
  CHECK(peopleIn(two) == 2);
  CHECK(peopleIn(chainBody(std::vector<vec3>(20, vec3(0))).skeleton) == 0);
  CHECK(peopleIn({}) == 0);
}
