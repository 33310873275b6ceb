#include "body/mesh_role.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

SkinnedMesh meshNamed(const char* name, vec4 weights) {
  SkinnedMesh mesh;
  mesh.name = name;
  mesh.influences.assign(3, {{0, 1, 0, 0}, weights});
  return mesh;
}

constexpr vec4 kRigid{1, 0, 0, 0}, kSmooth{0.5f, 0.5f, 0, 0};

}  // namespace

TEST_CASE("a mesh's name tells what it is") {
  CHECK(roleNamed("Bones") == MeshRole::bones);
  CHECK(roleNamed("skeleton_low") == MeshRole::bones);
  CHECK(roleNamed("cartilage") == MeshRole::bones);
  CHECK(roleNamed("teeth") == MeshRole::bones);
  CHECK(roleNamed("heart") == MeshRole::heart);
  CHECK(roleNamed("body") == MeshRole::skin);
  CHECK(roleNamed("organs") == MeshRole::organs);
  CHECK(roleNamed("Left Lung") == MeshRole::organs);
  CHECK(roleNamed("organ: heart") == MeshRole::heart);
  CHECK(roleNamed("organ: large bowel") == MeshRole::organs);
  CHECK(roleNamed("Keep-out: heart") == MeshRole::keepOut);
  CHECK(roleNamed("Object_4") == MeshRole::other);
  CHECK(roleNamed("") == MeshRole::other);
}

TEST_CASE(
    "vessels keep out of bones and heart, not of skin and organs; of the unnamed what moves by rigid parts counts") {
  CHECK(isSolid(meshNamed("bones", kSmooth)));
  CHECK(isSolid(meshNamed("heart", kRigid)));
  CHECK(isSolid(meshNamed("keep-out: heart", kRigid)));
  CHECK_FALSE(isSolid(meshNamed("organ: heart", kRigid)));
  CHECK_FALSE(isSolid(meshNamed("skin", kRigid)));
  CHECK_FALSE(isSolid(meshNamed("organs", kRigid)));
  CHECK(isSolid(meshNamed("Object_4", kRigid)));
  CHECK_FALSE(isSolid(meshNamed("Object_4", kSmooth)));
}
