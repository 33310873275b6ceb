#include "body/skinning.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

/// Two joints at the origin and at (0, 1, 0), bound there; one vertex on each and one on both.
Body twoJoints() {
  Body body;
  body.skeleton.joints.resize(2);
  auto& tip = body.skeleton.joints[1];
  tip.parent = JointId{0};
  tip.rest.translation = {0, 1, 0};
  tip.restWorld = tip.rest.matrix();
  tip.inverseBind = glm::inverse(tip.restWorld);
  SkinnedMesh mesh;
  mesh.mesh.positions = {{1, 0, 0}, {1, 1, 0}, {1, 2, 0}};
  mesh.normals = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  mesh.influences = {
      {{0, 0, 0, 0}, {1, 0, 0, 0}}, {{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}}, {{1, 0, 0, 0}, {1, 0, 0, 0}}};
  body.meshes.push_back(mesh);
  return body;
}

bool same(vec3 a, vec3 b) { return glm::distance(a, b) < 1e-6f; }

}  // namespace

TEST_CASE("vertices rest where they are bound and follow their joints") {
  const Body body = twoJoints();
  std::vector<vec3> positions, normals;
  skinVertices(body.meshes[0], skinMatrices(body.skeleton, restPose(body.skeleton)), positions, normals);
  CHECK(positions == body.meshes[0].mesh.positions);
  CHECK(normals == body.meshes[0].normals);
  // The tip turns by 90 degrees about z: (1, 2) goes to (-1, 2), and (1, 1) half way to (0, 2).
  std::vector<JointTransform> local = {body.skeleton.joints[0].rest, body.skeleton.joints[1].rest};
  local[1].rotation = glm::angleAxis(kPi / 2, vec3(0, 0, 1));
  const auto matrices = skinMatrices(body.skeleton, poseFromLocal(body.skeleton, local));
  skinVertices(body.meshes[0], matrices, positions, normals);
  CHECK(same(positions[0], {1, 0, 0}));
  CHECK(same(positions[1], {0.5f, 1.5f, 0}));
  CHECK(same(positions[2], {-1, 2, 0}));
  const float s = std::sqrt(0.5f);
  CHECK(same(normals[0], {1, 0, 0}));
  CHECK(same(normals[1], {s, s, 0}));
  CHECK(same(normals[2], {0, 1, 0}));
  std::vector<vec3> alone;
  skinPositions(body.meshes[0], matrices, alone);
  CHECK(alone == positions);
}

TEST_CASE("height is that of the meshes at rest, else of the joints") {
  Body body = twoJoints();
  CHECK(body.height() == 2);
  body.meshes.clear();
  CHECK(body.height() == 1);
  body.skeleton.joints.clear();
  CHECK(body.height() == 0);
}
