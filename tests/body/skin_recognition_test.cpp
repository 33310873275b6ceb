#include "body/skin_recognition.h"

#include <doctest/doctest.h>

#include "body/bone_field.h"
#include "body/coarser_levels.h"
#include "body/doll.h"
#include "body/mesh_role.h"
#include "body/skin_field.h"
#include "support/meshes.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// A box around a bone that bends with its two joints.
SkinnedMesh sleeve(const Body& body, const std::string& name, const std::vector<const char*>& parts,
                   float thick) {
  Aabb box;
  std::vector<std::uint16_t> joints;
  for (const char* part : parts) {
    const JointId joint = body.skeleton.find(part);
    box.add(vec3(body.skeleton.joints[joint.value].restWorld[3]));
    joints.push_back(std::uint16_t(joint.value));
  }
  SkinnedMesh mesh = boxMesh(name, box.low - thick, box.high + thick);
  for (SkinInfluence& influence : mesh.influences)
    influence = {{joints.front(), joints.back(), 0, 0}, vec4(0.5f, 0.5f, 0, 0)};
  return mesh;
}

SkinnedMesh whole(const Body& body, const std::string& name, float thick) {
  SkinnedMesh mesh = sleeve(body, name, {"leftToes", "rightHand"}, thick);
  Aabb box;
  for (const auto& joint : body.skeleton.joints) box.add(vec3(joint.restWorld[3]));
  SkinnedMesh all = boxMesh(name, box.low - thick, box.high + thick);
  for (SkinInfluence& influence : all.influences) influence = {{0, 1, 0, 0}, vec4(0.5f, 0.5f, 0, 0)};
  return all;
}

}  // namespace

TEST_CASE(
    "a skin is known by enclosing the skeleton, whatever it is called; what lies within stays what it is") {
  Body body = dollBody("vrm");
  body.meshes = {whole(body, "Object_7", 0.1f), sleeve(body, "Object_8", {"neck", "head"}, 0.02f),
                 whole(body, "Coat", 0.15f)};
  recogniseSkin(body);
  REQUIRE(body.meshes.size() == 2);
  CHECK(roleNamed(body.meshes[0].name) == MeshRole::skin);
  CHECK(body.meshes[0].name.find("Coat") != std::string::npos);
  CHECK(body.meshes[0].name.find("Object_7") != std::string::npos);
  CHECK(body.meshes[1].name == "Object_8");
  CHECK(skinOf(body) == &body.meshes[0]);
  CHECK(body.meshes[0].mesh.positions.size() == body.meshes[0].influences.size());
}

TEST_CASE("a head, hair and shoes that follow one joint belong to the skin; eyes and bones within do not") {
  Body body = dollBody("vrm");
  const vec3 head(body.skeleton.joints[body.skeleton.find("head").value].restWorld[3]);
  const auto onHead = [&](const char* name, vec3 low, vec3 high) {
    SkinnedMesh mesh = boxMesh(name, head + low, head + high);
    for (SkinInfluence& influence : mesh.influences)
      influence = {{std::uint16_t(body.skeleton.find("head").value), 0, 0, 0}, vec4(1, 0, 0, 0)};
    return mesh;
  };
  const SkinnedMesh face = onHead("Object_9", vec3(-0.3f, 0.2f, -0.3f), vec3(0.3f, 0.6f, 0.3f)),
                    eyes = onHead("Object_10", vec3(-0.1f, 0.4f, 0.1f), vec3(0.1f, 0.5f, 0.2f)),
                    hair = onHead("Object_11", vec3(-0.31f, 0.55f, -0.31f), vec3(0.31f, 0.7f, 0.31f)),
                    femur = onHead("Object_12", vec3(-0.02f, -0.9f, -0.02f), vec3(0.02f, -0.5f, 0.02f));
  for (const char* skin : {"Object_7", "skin"}) {
    body.meshes = {whole(body, skin, 0.1f), face, eyes, hair, femur};
    recogniseSkin(body);
    REQUIRE(body.meshes.size() == 3);
    CHECK(roleNamed(body.meshes[0].name) == MeshRole::skin);
    CHECK(body.meshes[0].name.find("Object_9") != std::string::npos);
    CHECK(body.meshes[0].name.find("Object_11") != std::string::npos);
    CHECK(body.meshes[1].name == "Object_10");
    CHECK(body.meshes[2].name == "Object_12");
  }
}

TEST_CASE("a skin in pieces is one") {
  Body body = dollBody("vrm");
  for (const auto& [name, parts] :
       std::vector<std::pair<std::string, std::vector<const char*>>>{{"torso", {"hips", "neck"}},
                                                                     {"a", {"leftUpperArm", "leftHand"}},
                                                                     {"b", {"rightUpperArm", "rightHand"}},
                                                                     {"c", {"leftUpperLeg", "leftFoot"}},
                                                                     {"d", {"rightUpperLeg", "rightFoot"}}})
    body.meshes.push_back(sleeve(body, name, parts, 0.06f));
  recogniseSkin(body);
  REQUIRE(body.meshes.size() == 1);
  CHECK(roleNamed(body.meshes[0].name) == MeshRole::skin);
}

TEST_CASE("a skin of rigid parts is no bone that vessels are kept out of") {
  Body body = dollBody("vrm");
  SkinnedMesh shell = whole(body, "robot", 0.1f);
  for (SkinInfluence& influence : shell.influences) influence = {{1, 0, 0, 0}, vec4(1, 0, 0, 0)};
  body.meshes = {shell};
  CHECK(isSolid(body.meshes[0]));
  recogniseSkin(body);
  CHECK(!isSolid(body.meshes[0]));
  CHECK(skinOf(body) == &body.meshes[0]);
}

TEST_CASE("named skins, bones and what encloses nothing are left alone") {
  Body body = dollBody("vrm");
  SkinnedMesh bones = sleeve(body, "bones", {"hips", "neck"}, 0.01f);
  for (SkinInfluence& influence : bones.influences) influence = {{1, 0, 0, 0}, vec4(1, 0, 0, 0)};
  body.meshes = {whole(body, "body", 0.1f), bones};
  recogniseSkin(body);
  CHECK(body.meshes[0].name == "body");
  CHECK(body.meshes[1].name == "bones");
  body.meshes = {sleeve(body, "Hat", {"neck", "head"}, 0.02f)};
  recogniseSkin(body);
  CHECK(body.meshes[0].name == "Hat");
}

TEST_CASE("of levels of detail the finest is the body, also where its materials are told apart") {
  Body body = dollBody("vrm");
  for (const char* name : {"Body_LOD2", "Body_LOD0/skin", "Body_LOD0/cloth", "Body_LOD1/skin", "Boots_LOD1",
                           "explodes2", "explodes1"})
    body.meshes.push_back(whole(body, name, 0.1f));
  body.meshes.erase(body.meshes.begin(), body.meshes.end() - 7);
  CHECK(leaveOutCoarserLevels(body) == std::vector<std::string>{"Body_LOD2", "Body_LOD1/skin"});
  CHECK(body.meshes.size() == 5);
}

TEST_CASE(
    "with one joint, as a phantom has, everything is rigid, and the skin is what it is called or no bone") {
  Body body = dollBody("vrm");
  body.skeleton.joints.resize(1);
  SkinnedMesh skull = boxMesh("skeleton", vec3(-0.2f), vec3(0.2f)),
              figure = boxMesh("Figure", vec3(-0.1f), vec3(0.1f));
  body.meshes = {skull};
  CHECK(!skinOf(body));
  body.meshes = {skull, figure};
  recogniseSkin(body);
  CHECK(skinOf(body) == &body.meshes[1]);
}
