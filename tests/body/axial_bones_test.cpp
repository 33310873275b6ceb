#include "body/axial_bones.h"

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

enum class Ribs { apart, joined, held, cage };

// Vertebrae from the hips (0.95 m) to the head (1.55 m), in the blocks of the joints below them; ribs beside
// some of them that reach down, a centimetre away or joined to them by a millimetre, also with their fronts
// joined to a plate or all in one piece; a block as long as a link, and a skull.
Body spinalDoll(Ribs ribs = Ribs::apart) {
  Body body = dollBody("cmu");
  SkinnedMesh bones;
  bones.name = "bones";
  const auto carrier = [](float y) {
    return y < 1.05f ? "Hips" : y < 1.2f ? "LowerBack" : y < 1.45f ? "Spine" : "Neck";
  };
  for (float y = 0.98f; y < 1.54f; y += kPitch)
    addBox(body, bones, {0, y, -0.01f}, {0.03f, 0.01f, 0.03f}, carrier(y));
  for (const float side : {-1.0f, 1.0f})
    for (int k = 0; k < 5; ++k) {
      const auto first = std::uint32_t(bones.mesh.positions.size());
      const float x = ribs == Ribs::apart ? 0.07f : 0.061f;
      addBox(body, bones, {x * side, 1.25f + kPitch * float(k), -0.01f}, {0.03f, 0.04f, 0.03f},
             ribs == Ribs::cage && k > 2 ? "LowerBack" : "Spine");
      if (ribs == Ribs::cage && k > 0) bones.mesh.triangles.push_back({first, first - 1, first - 2});
      if (ribs == Ribs::held)
        addBox(body, bones, {0.102f * side, 1.25f + kPitch * float(k), -0.01f}, {0.01f, 0.04f, 0.03f},
               "LowerBack");
    }
  addBox(body, bones, {0, 1.325f, 0.05f}, {0.05f, 0.126f, 0.05f}, "Spine");
  addBox(body, bones, {0, 1.64f, 0}, {0.07f, 0.1f, 0.09f}, "Head");
  body.meshes.push_back(std::move(bones));
  return body;
}

const Body& separated() {
  static const Body body = [] {
    Body doll = spinalDoll();
    separateAxialBones(doll);
    return doll;
  }();
  return body;
}

std::vector<vec4> middles() {
  std::vector<vec4> points;
  for (const AxialBone& bone : separated().axialBones) points.emplace_back(bone.place, 0.002f);
  for (const float x : {-0.04f, 0.04f})
    for (float y = 0.96f; y < 1.5f; y += 0.01f) points.emplace_back(x, y, 0, 0.002f);
  return points;
}

}  // namespace

TEST_CASE("vertebrae are what lies around the line from the hips to the head, shorter than its links") {
  const Body& body = separated();
  CHECK(body.axialBones.size() == 20);  // 23 less three that the hips carry
  for (const AxialBone& bone : body.axialBones) {
    CHECK(std::abs(bone.place.x) < 1e-6f);
    CHECK(bone.place.z == doctest::Approx(-0.01f));
    const std::string& carrier = body.skeleton.joints[bone.carrier.value].name;
    CHECK(carrier == (bone.place.y < 1.2f ? "LowerBack" : bone.place.y < 1.45f ? "Spine" : "Neck"));
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

TEST_CASE("vertebrae of a cage in one piece, and those between them, keep to their blocks") {
  Body body = spinalDoll(Ribs::cage);
  separateAxialBones(body);
  CHECK(body.axialBones.size() == 15);
  for (const AxialBone& bone : body.axialBones) CHECK((bone.place.y < 1.275f || bone.place.y > 1.385f));
}

// The fronts go with the flesh, or with the plates that the lower back carries.
TEST_CASE("a rib hangs on its vertebra, and its front end goes where what is there does") {
  for (const Ribs kind : {Ribs::joined, Ribs::held}) {
    Body body = spinalDoll(kind);
    separateAxialBones(body);
    REQUIRE(body.axialBones.size() == 20 + 10);
    std::vector<vec4> points;
    for (const AxialBone& bone : body.axialBones) points.emplace_back(bone.place, 0.002f);
    const auto binding = bindPoints(body, points, "places");
    REQUIRE(binding.ok());
    Deformer deformer(*binding);
    std::vector<vec4> moved(points.size());
    const Pose pose =
        turned(body, {{body.skeleton.find("Spine").value, glm::angleAxis(0.4f, vec3(0.6f, 0, 0.8f))}});
    deformer.run(points, pose, moved);
    std::vector<mat4> matrices = skinMatrices(body, pose);
    const std::span bones = std::span(matrices).subspan(body.skeleton.joints.size());
    deformer.axialBones(body, bones);
    const auto at = [](const mat4& matrix, vec3 place) { return vec3(matrix * vec4(place, 1)); };
    float widest = 0;  // by which a rib turns on its vertebra
    for (std::size_t k = 20; k < bones.size(); ++k) {
      const AxialBone& rib = body.axialBones[k];
      const mat4& vertebra = bones[rib.vertebra];
      CHECK(body.axialBones[rib.vertebra].place.y == doctest::Approx(1.28f + kPitch * float((k - 20) % 5)));
      CHECK(std::abs(rib.root.x) == doctest::Approx(0.031f));
      CHECK(std::abs(rib.place.x) == doctest::Approx(0.091f));
      CHECK(rib.frontCarrier.valid() == (kind == Ribs::held));
      CHECK(glm::distance(at(bones[k], rib.root), at(vertebra, rib.root)) < 1e-5f);
      const vec3 front = kind == Ribs::held ? at(matrices[body.skeleton.find("LowerBack").value], rib.place)
                                            : vec3(moved[k]);
      const vec3 root = at(bones[k], rib.root);
      const auto off = [&](const mat4& matrix) {
        return glm::distance(glm::normalize(at(matrix, rib.place) - root), glm::normalize(front - root));
      };
      CHECK(off(bones[k]) < (kind == Ribs::held ? 1e-4f : 0.02f));  // arms take part in a vessel's motion
      CHECK(glm::determinant(mat3(bones[k])) == doctest::Approx(1).epsilon(1e-5));
      widest = std::max(widest, off(vertebra));
    }
    CHECK(widest > 0.03f);
  }
}

TEST_CASE("a skin of stiff shells is no bone") {
  Body body = spinalDoll(Ribs::joined);
  body.meshes.back().name = "skin: shells";
  separateAxialBones(body);
  CHECK(body.axialBones.empty());
}

TEST_CASE("a body of which head and hips are not known keeps its blocks") {
  Body body = spinalDoll();
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j)
    body.skeleton.joints[j].name = "joint " + std::to_string(j);
  for (Skeleton::Joint& joint : body.skeleton.joints)  // and no shape to tell them by
    joint.restWorld[3] = vec4(0, joint.restWorld[3].y, 0, 1);
  separateAxialBones(body);
  CHECK(body.axialBones.empty());
}

TEST_CASE("vertebrae move as vessels in their middles do, and share a joint's bend") {
  const Body& body = separated();
  const std::vector<vec4> points = middles();
  const auto binding = bindPoints(body, points, "middles");
  REQUIRE(binding.ok());
  Deformer deformer(*binding);
  std::vector<vec4> moved(points.size());
  std::vector<mat4> motions(body.axialBones.size());

  deformer.run(points, restPose(body.skeleton), moved);
  deformer.axialBones(body, motions);
  for (const mat4& motion : motions)
    for (int k = 0; k < 4; ++k) CHECK(glm::distance(motion[k], mat4(1)[k]) < 1e-6f);

  const float bend = glm::radians(40.0f);
  const quat turn = glm::angleAxis(bend, glm::normalize(vec3(1, 0.5f, 0.2f)));
  deformer.run(points, turned(body, {{body.skeleton.find("Neck").value, turn}}), moved);
  deformer.axialBones(body, motions);
  float largestStep = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    CHECK(glm::distance(vec3(motions[k] * vec4(body.axialBones[k].place, 1)), vec3(moved[k])) < 1e-5f);
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
  REQUIRE(matrices.size() == body.skeleton.joints.size() + body.axialBones.size());
  const Body before = spinalDoll();
  std::vector<vec3> here, there;
  skinPositions(body.meshes[0], matrices, here);
  skinPositions(before.meshes[0], skinMatrices(before.skeleton, pose), there);
  CHECK(here == there);
}
