#include "body/phases.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "body/chain.h"

using namespace vasa;
using namespace vasa::test;

namespace {

/// A tube of skin around a vertical line. @param behind  the joint's share at a height
template <class Share>
void addSkin(SkinnedMesh& skin, vec3 from, float length, float radius, std::uint16_t before,
             std::uint16_t joint, const Share& behind) {
  constexpr std::uint32_t kAround = 16, kAlong = 40;
  const auto base = std::uint32_t(skin.mesh.positions.size());
  for (std::uint32_t i = 0; i < kAlong; ++i)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const float angle = 2 * kPi * float(k) / kAround, y = from.y + length * float(i) / (kAlong - 1);
      skin.mesh.positions.emplace_back(from.x + radius * std::cos(angle), y,
                                       from.z + radius * std::sin(angle));
      const float share = std::clamp(behind(y), 0.02f, 0.98f);
      skin.influences.push_back({{before, joint, 0, 0}, vec4(1 - share, share, 0, 0)});
      if (i == 0) continue;
      const std::uint32_t a = base + i * kAround + k, b = base + i * kAround + (k + 1) % kAround;
      skin.mesh.triangles.emplace_back(a, b - kAround, a - kAround);
      skin.mesh.triangles.emplace_back(a, b, b - kAround);
    }
}

/// Vertices along a segment that move with one joint.
void addBone(SkinnedMesh& bones, std::uint16_t joint, vec3 from, vec3 to) {
  constexpr std::uint32_t kVertices = 100;
  for (std::uint32_t i = 0; i < kVertices; ++i) {
    bones.mesh.positions.push_back(glm::mix(from, to, float(i) / (kVertices - 1)));
    bones.influences.push_back({{joint, 0, 0, 0}, vec4(1, 0, 0, 0)});
  }
}

}  // namespace

TEST_CASE("a step in a phase along a vessel becomes a ramp, and what is flat stays") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  spines->joints[1].arc = 0.5f;
  constexpr std::uint32_t kCount = 21;
  std::vector<vec4> points;
  std::vector<Tie> ties;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    points.emplace_back(0, 0.05f * float(i), 0, 0.001f);
    if (i) ties.push_back({i - 1, i});
  }
  Phases phases{kCount, std::vector<float>(3 * kCount, 1.0f), std::vector<float>(3 * kCount, 1.0f),
                std::vector<float>(3 * kCount, 1.0f)};
  for (std::uint32_t i = 0; i < kCount / 2; ++i) phases.bend[phases.at(1, i)] = 0;
  limitSlopes(phases, *spines, points, ties);

  const float steepest = 1.5f * 1.25f / 0.5f * 0.05f;
  for (std::uint32_t i = 1; i < kCount; ++i) {
    const float change = phases.bend[phases.at(1, i)] - phases.bend[phases.at(1, i - 1)];
    CHECK(change >= 0);
    CHECK(change <= steepest + 1e-5f);
  }
  CHECK(phases.bend[phases.at(1, 0)] == 0);
  CHECK(phases.bend[phases.at(1, kCount - 1)] == 1);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    CHECK(phases.bend[phases.at(0, i)] == 1);
    CHECK(phases.twist[phases.at(1, i)] == 1);
  }
}

TEST_CASE("a joint has set in behind it and not before it") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  for (SpineJoint& joint : spines->joints) joint.arc = 0.2f;
  const BoneField bones(body, *spines);
  const std::vector<vec4> points{{0.05f, 0.5f, 0, 1}, {0.05f, 1, 0, 1}, {0.05f, 1.5f, 0, 1}};
  const Phases phases = measurePhases(*spines, bones, SkinField(body), points);
  CHECK(phases.bend[phases.at(1, 0)] == 0);
  CHECK(phases.bend[phases.at(1, 1)] == doctest::Approx(0.5));
  CHECK(phases.bend[phases.at(1, 2)] == 1);
  CHECK(phases.nearness[phases.at(0, 1)] == 1);
}

TEST_CASE("flesh at the root of a limb follows the limb, though the bone before it is nearer") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  SkinnedMesh& bones = body.meshes.emplace_back();
  addBone(bones, 0, {0, 0, 0}, {0, 1, 0});
  addBone(bones, 0, {0.1f, 0.9f, 0.06f}, {0.1f, 1.1f, 0.06f});  // reaches past the joint as the pubis does
  addBone(bones, 1, {0, 1, 0}, {0, 2, 0});
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  for (SpineJoint& joint : spines->joints) joint.arc = 0.3f, joint.spreadsTwist = false;
  const std::vector<vec4> points{{0.1f, 1.08f, 0, 1}, {0.1f, 0.9f, 0, 1}};
  const Phases bare = measurePhases(*spines, BoneField(body, *spines), SkinField(body), points);
  CHECK(bare.bend[bare.at(1, 0)] < 0.5f);

  SkinnedMesh skin;
  addSkin(skin, {0, 0, 0}, 2, 0.13f, 0, 1, [](float y) { return 0.5f + 10 * (y - 1); });
  body.meshes.push_back(skin);
  const Phases clad = measurePhases(*spines, BoneField(body, *spines), SkinField(body), points);
  CHECK(clad.bend[clad.at(1, 0)] > 0.8f);
  CHECK(clad.bend[clad.at(1, 1)] < 0.1f);
}

TEST_CASE(
    "the bone before a joint, where it reaches far down beside the link after it, holds no flesh back") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  SkinnedMesh& bones = body.meshes.emplace_back();
  addBone(bones, 0, {0, 0, 0}, {0, 1, 0});
  addBone(bones, 0, {0.1f, 0.9f, 0.05f}, {0.1f, 1.3f, 0.05f});  // as the seat bone does
  addBone(bones, 1, {0, 1, 0}, {0, 2, 0});
  SkinnedMesh skin;
  addSkin(skin, {0, 0, 0}, 2, 0.2f, 0, 1, [](float y) { return 0.5f + 10 * (y - 1); });
  body.meshes.push_back(skin);
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  for (SpineJoint& joint : spines->joints) joint.arc = 0.3f, joint.spreadsTwist = false;
  const std::vector<vec4> points{{0.08f, 1.15f, 0, 1}, {0.1f, 1.15f, 0.045f, 1}, {0.08f, 0.85f, 0, 1}};
  const Phases phases = measurePhases(*spines, BoneField(body, *spines), SkinField(body), points);
  CHECK(phases.bend[phases.at(1, 0)] > 0.95f);
  CHECK(phases.bend[phases.at(1, 1)] < 0.2f);  // on that bone
  CHECK(phases.bend[phases.at(1, 2)] < 0.1f);
}

TEST_CASE("inside one leg's skin the other leg has no share") {
  Body body = chainBody({{0, 0, 0}, {0.1f, 0, 0}, {0.1f, -1, 0}, {-0.1f, 0, 0}, {-0.1f, -1, 0}});
  body.skeleton.joints[3].parent = {0};
  SpineSet spines = *deriveSpines(body.skeleton, body.name);
  for (SpineJoint& joint : spines.joints) joint.arc = 0.1f;
  const std::vector<vec4> points{{0.018f, -0.5f, 0, 1}};
  const Phases bare = measurePhases(spines, BoneField(body, spines), SkinField(body), points);
  CHECK(bare.nearness[bare.at(3, 0)] > 0.1f);

  SkinnedMesh skin;
  addSkin(skin, {0.1f, -1, 0}, 1, 0.09f, 0, 1, [](float) { return 1.0f; });
  addSkin(skin, {-0.1f, -1, 0}, 1, 0.09f, 0, 3, [](float) { return 1.0f; });
  body.meshes.push_back(skin);
  const Phases clad = measurePhases(spines, BoneField(body, spines), SkinField(body), points);
  CHECK(clad.nearness[clad.at(1, 0)] > 0.9f);
  CHECK(clad.nearness[clad.at(3, 0)] < 0.03f);
}
