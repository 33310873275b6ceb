#include "body/props.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "body/person.h"
#include "mesh/components.h"
#include "support/meshes.h"

using namespace vasa;
using namespace vasa::test;

namespace {

SkinnedMesh piece(const Body& body, const char* name, const char* joint, vec3 from, vec3 to) {
  const JointId own = body.skeleton.find(joint);
  const vec3 at(body.skeleton.joints[own.value].restWorld[3]);
  SkinnedMesh mesh = boxMesh(name, at + glm::min(from, to), at + glm::max(from, to));
  for (SkinInfluence& influence : mesh.influences)
    influence = {{std::uint16_t(own.value), 0, 0, 0}, vec4(1, 0, 0, 0)};
  return mesh;
}

const vec3 kThin(0.02f);
SkinnedMesh sword(const Body& body, const char* name) {
  return piece(body, name, "rightHand", -kThin, kThin + vec3(0, 1.5f, 0));
}

}  // namespace

TEST_CASE(
    "a sword in a hand, a flag on the back and the floor are left out: a body is as tall as its person") {
  const Body plain = person();
  Body body = plain;
  body.meshes.push_back(sword(body, "blade"));
  body.meshes.push_back(piece(body, "flag", "chest", -kThin, kThin + vec3(0, 1, 0)));
  body.meshes.push_back(piece(body, "floor", "hips", vec3(-9, -1, -9), vec3(9, -0.95f, 9)));
  CHECK(body.height() > plain.height() + 0.3f);
  CHECK(leaveOutProps(body) == std::vector<std::string>{"blade", "flag", "floor"});
  REQUIRE(body.meshes.size() == plain.meshes.size());
  CHECK(body.height() == plain.height());
}

TEST_CASE("a sword that is part of the skin's own mesh goes, and what is left moves as before") {
  const Body plain = person();
  Body body = plain;
  SkinnedMesh& skin = body.meshes[0];
  const SkinnedMesh blade = sword(body, "blade");
  // Before the skin's own, so that all of its corners are numbered anew.
  SkinnedMesh both = blade;
  appendMesh(both.mesh, skin.mesh);
  both.normals.insert(both.normals.end(), skin.normals.begin(), skin.normals.end());
  both.influences.insert(both.influences.end(), skin.influences.begin(), skin.influences.end());
  both.name = skin.name;
  skin = both;
  CHECK(leaveOutProps(body) == std::vector<std::string>{"skin"});
  const SkinnedMesh& left = body.meshes[0];
  CHECK(left.mesh.positions == plain.meshes[0].mesh.positions);
  CHECK(left.mesh.triangles == plain.meshes[0].mesh.triangles);
  CHECK(left.influences.size() == plain.meshes[0].influences.size());
  CHECK(std::ranges::equal(left.influences, plain.meshes[0].influences, {}, &SkinInfluence::joints,
                           &SkinInfluence::joints));
}

TEST_CASE("what is a person's own stays: hats, limbs of one piece, bones; others' skeletons tell nothing") {
  Body body = person();
  body.meshes.push_back(piece(body, "hat", "head", vec3(-0.15f, 0.2f, -0.15f), vec3(0.15f, 0.3f, 0.15f)));
  body.meshes.push_back(piece(body, "leg", "leftUpperLeg", -kThin - vec3(0, 2, 0), kThin));
  body.meshes.push_back(piece(body, "bones of a tail", "hips", -kThin - vec3(0, 0, 1), kThin));
  CHECK(leaveOutProps(body).empty());
  Body other = person();
  for (auto& joint : other.skeleton.joints) joint.name = "x";
  other.skeleton.joints.resize(1);
  for (SkinInfluence& influence : other.meshes[0].influences) influence = {{0, 0, 0, 0}, vec4(1, 0, 0, 0)};
  CHECK(leaveOutProps(other).empty());
  CHECK(other.meshes.size() == 1);
}
