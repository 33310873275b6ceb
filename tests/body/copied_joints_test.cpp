#include "body/copied_joints.h"

#include <doctest/doctest.h>

#include "body/person.h"
#include "body/skinning.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// The body's joints once more, and a coat of its first mesh on them.
void dress(Body& body, vec3 aside) {
  const auto count = std::uint32_t(body.skeleton.joints.size());
  for (std::uint32_t j = 0; j < count; ++j) {
    Skeleton::Joint copy = body.skeleton.joints[j];
    copy.name += "_" + std::to_string(100 + j);
    if (copy.parent.valid())
      copy.parent.value += count;
    else
      copy.rest.translation += aside;
    copy.restWorld[3] += vec4(aside, 0);
    body.skeleton.joints.push_back(copy);
  }
  SkinnedMesh coat = body.meshes.front();
  coat.name = "coat";
  for (SkinInfluence& influence : coat.influences)
    for (std::uint16_t& joint : influence.joints) joint = std::uint16_t(joint + count);
  body.meshes.push_back(coat);
}

// How many become one with others, where the first so many are the body's and the others the clothes'.
std::size_t united(Body& body, std::size_t ofBody) {
  const std::size_t before = body.skeleton.joints.size();
  std::vector<std::uint32_t> skins(before, 1);
  std::fill_n(skins.begin(), ofBody, 0u);
  CHECK(uniteCopiedJoints(body, skins).size() == before);
  return before - body.skeleton.joints.size();
}

}  // namespace

TEST_CASE("clothes on a copy of the skeleton move with the body's, and so does what the copy alone has") {
  Body body = person();
  const std::size_t joints = body.skeleton.joints.size();
  const JointId hips = body.skeleton.find("hips"), elbow = body.skeleton.find("leftLowerArm");
  dress(body, vec3(0));
  Skeleton::Joint skirt = body.skeleton.joints[hips.value];
  skirt.name = "skirt";
  skirt.parent = {std::uint32_t(joints) + hips.value};
  skirt.rest = {};
  body.skeleton.joints.push_back(skirt);
  JointTracks bend;
  bend.joint = {std::uint32_t(joints) + elbow.value};  // keyed in the copy alone
  bend.rotation = {Interpolation::linear, {0}, {glm::angleAxis(1.0f, vec3(0, 1, 0))}};
  Clip clip;
  clip.tracks = {bend};
  body.clips = {clip};
  CHECK(united(body, joints) == joints);
  REQUIRE(body.skeleton.joints.size() == joints + 1);
  CHECK(body.skeleton.joints.back().parent == hips);
  CHECK(body.clips[0].tracks[0].joint == elbow);
  const SkinnedMesh &skin = body.meshes.front(), &coat = body.meshes.back();
  for (std::size_t v = 0; v < skin.influences.size(); ++v)
    CHECK(coat.influences[v].joints == skin.influences[v].joints);
}

TEST_CASE("so do clothes where one node stands above both skeletons") {
  Body body = person();
  for (Skeleton::Joint& joint : body.skeleton.joints) joint.parent.value += joint.parent.valid() ? 1 : 0;
  for (SkinnedMesh& mesh : body.meshes)
    for (SkinInfluence& influence : mesh.influences)
      for (std::uint16_t& joint : influence.joints) ++joint;
  Skeleton::Joint top;
  top.name = "Armature";
  body.skeleton.joints.insert(body.skeleton.joints.begin(), top);
  for (Skeleton::Joint& joint : body.skeleton.joints)
    if (!joint.parent.valid() && joint.name != top.name) joint.parent = {0};
  const std::size_t joints = body.skeleton.joints.size();
  dress(body, vec3(0));
  for (std::size_t j = joints + 1; j < body.skeleton.joints.size(); ++j)
    if (body.skeleton.joints[j].parent.value == joints) body.skeleton.joints[j].parent = {0};
  body.skeleton.joints[joints].parent = {0};  // the copy of the top hangs there too, and stays
  body.skeleton.joints[joints].name = "Clothes";
  CHECK(united(body, joints) == joints - 1);
}

TEST_CASE("somebody else of the same names who stands beside is no copy") {
  Body body = person();
  const std::size_t joints = body.skeleton.joints.size();
  dress(body, {1, 0, 0});
  CHECK(united(body, joints) == 0);
  CHECK(body.skeleton.joints.size() == 2 * joints);
}

TEST_CASE("joints of one skin, without names or numbered alone, stay apart in one place") {
  Body body = person();
  for (Skeleton::Joint& joint : body.skeleton.joints)
    joint.name = "Bone", joint.restWorld = body.skeleton.joints[0].restWorld;
  CHECK(united(body, body.skeleton.joints.size()) == 0);
}
