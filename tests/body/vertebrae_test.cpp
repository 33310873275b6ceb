#include "body/vertebrae.h"

#include <doctest/doctest.h>

#include "body/binding.h"
#include "body/chain.h"
#include "body/deform.h"
#include "body/doll.h"
#include "body/skinning.h"
#include "mesh/components.h"
#include "support/meshes.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr float kPitch = 0.025f;  // of the doll's vertebrae [m]

void addBox(Body& body, SkinnedMesh& bones, vec3 centre, vec3 half, const char* joint) {
  const SkinnedMesh box = boxMesh("bones", centre - half, centre + half);
  appendMesh(bones.mesh, box.mesh);
  bones.normals.insert(bones.normals.end(), box.normals.begin(), box.normals.end());
  const auto carrier = std::uint16_t(body.skeleton.find(joint).value);
  bones.influences.insert(bones.influences.end(), box.normals.size(), {{carrier}, {1, 0, 0, 0}});
}

// Vertebrae from the hips (0.95 m) to the head (1.55 m), in the blocks of the joints below them; ribs beside
// one of them, a millimetre away or not joined to it, a block as long as a link, and a skull.
Body spinalDoll(bool joined = false) {
  Body body = dollBody("cmu");
  SkinnedMesh bones;
  bones.name = "bones";
  const auto carrier = [](float y) {
    return y < 1.05f ? "Hips" : y < 1.2f ? "LowerBack" : y < 1.45f ? "Spine" : "Neck";
  };
  for (float y = 0.98f; y < 1.54f; y += kPitch)
    addBox(body, bones, {0, y, -0.01f}, {0.03f, 0.01f, 0.03f}, carrier(y));
  for (const float side : {-1.0f, 1.0f})
    for (const float y : {1.28f, 1.38f})
      addBox(body, bones, {(joined ? 0.091f : 0.1f) * side, y, -0.01f}, {0.06f, 0.01f, 0.03f}, "Spine");
  addBox(body, bones, {0, 1.325f, 0.05f}, {0.05f, 0.126f, 0.05f}, "Spine");
  addBox(body, bones, {0, 1.64f, 0}, {0.07f, 0.1f, 0.09f}, "Head");
  body.meshes.push_back(std::move(bones));
  return body;
}

const Body& separated() {
  static const Body body = [] {
    Body doll = spinalDoll();
    separateVertebrae(doll);
    return doll;
  }();
  return body;
}

std::vector<vec4> middles() {
  std::vector<vec4> points;
  for (const Vertebra& vertebra : separated().vertebrae) points.emplace_back(vertebra.centre, 0.002f);
  for (const float x : {-0.04f, 0.04f})
    for (float y = 0.96f; y < 1.5f; y += 0.01f) points.emplace_back(x, y, 0, 0.002f);
  return points;
}

}  // namespace

TEST_CASE("vertebrae are what lies around the line from the hips to the head, shorter than its links") {
  const Body& body = separated();
  CHECK(body.vertebrae.size() == 20);  // 23 less three that the hips carry
  for (const Vertebra& vertebra : body.vertebrae) {
    CHECK(std::abs(vertebra.centre.x) < 1e-6f);
    CHECK(vertebra.centre.z == doctest::Approx(-0.01f));
    const std::string& carrier = body.skeleton.joints[vertebra.carrier.value].name;
    CHECK(carrier == (vertebra.centre.y < 1.2f ? "LowerBack" : vertebra.centre.y < 1.45f ? "Spine" : "Neck"));
  }
  const Body before = spinalDoll();
  std::size_t own = 0;
  for (std::size_t v = 0; v < body.meshes[0].influences.size(); ++v) {
    const std::uint16_t named = body.meshes[0].influences[v].joints[0];
    CHECK(body.carrier(named) == before.meshes[0].influences[v].joints[0]);
    own += named >= body.skeleton.joints.size();
  }
  CHECK(own == 20 * 24);
}

TEST_CASE("vertebrae with ribs, and those between them, keep to their blocks") {
  Body body = spinalDoll(true);
  separateVertebrae(body);
  CHECK(body.vertebrae.size() == 15);
  for (const Vertebra& vertebra : body.vertebrae)
    CHECK((vertebra.centre.y < 1.275f || vertebra.centre.y > 1.385f));
}

TEST_CASE("a body of which head and hips are not known keeps its blocks") {
  Body body = spinalDoll();
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j)
    body.skeleton.joints[j].name = "joint " + std::to_string(j);
  for (Skeleton::Joint& joint : body.skeleton.joints)  // and no shape to tell them by
    joint.restWorld[3] = vec4(0, joint.restWorld[3].y, 0, 1);
  separateVertebrae(body);
  CHECK(body.vertebrae.empty());
}

TEST_CASE("vertebrae move as vessels in their middles do, and share a joint's bend") {
  const Body& body = separated();
  const std::vector<vec4> points = middles();
  const auto binding = bindPoints(body, points, "middles");
  REQUIRE(binding.ok());
  Deformer deformer(*binding);
  std::vector<vec4> moved(points.size());
  std::vector<mat4> motions(body.vertebrae.size());

  deformer.run(points, restPose(body.skeleton), moved);
  deformer.vertebrae(motions);
  for (const mat4& motion : motions)
    for (int k = 0; k < 4; ++k) CHECK(glm::distance(motion[k], mat4(1)[k]) < 1e-6f);

  const float bend = glm::radians(40.0f);
  const quat turn = glm::angleAxis(bend, glm::normalize(vec3(1, 0.5f, 0.2f)));
  deformer.run(points, turned(body, {{body.skeleton.find("Neck").value, turn}}), moved);
  deformer.vertebrae(motions);
  float largestStep = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    CHECK(glm::distance(vec3(motions[k] * vec4(body.vertebrae[k].centre, 1)), vec3(moved[k])) < 1e-5f);
    CHECK(glm::determinant(mat3(motions[k])) == doctest::Approx(1).epsilon(1e-5));
    if (k > 0)
      largestStep = std::max(largestStep, glm::angle(glm::quat_cast(mat3(motions[k])) *
                                                     glm::conjugate(glm::quat_cast(mat3(motions[k - 1])))));
  }
  CHECK(glm::angle(glm::quat_cast(mat3(motions.front()))) < 1e-3f);
  CHECK(glm::angle(glm::quat_cast(mat3(motions.back()))) == doctest::Approx(bend).epsilon(0.05));
  CHECK(largestStep < 0.6f * bend);  // the rig's blocks take it all at once
}

TEST_CASE("vertebrae to which nothing is bound ride with their joints") {
  const Body& body = separated();
  const Pose pose = turned(body, {{body.skeleton.find("Neck").value, glm::angleAxis(0.5f, vec3(1, 0, 0))}});
  const std::vector<mat4> matrices = skinMatrices(body, pose);
  REQUIRE(matrices.size() == body.skeleton.joints.size() + body.vertebrae.size());
  const Body before = spinalDoll();
  std::vector<vec3> here, there;
  skinPositions(body.meshes[0], matrices, here);
  skinPositions(before.meshes[0], skinMatrices(before.skeleton, pose), there);
  CHECK(here == there);
}
