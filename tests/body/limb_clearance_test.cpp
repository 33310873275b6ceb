#include "body/limb_clearance.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "body/person.h"
#include "body/skinning.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr int kFrames = 61;
constexpr float kThrough = 52, kClear = 25;  // [degrees] it hangs by 56

// The left arm of a person that holds them aside is lowered and raised again.
Clip lowered(const Body& body, float degrees) {
  Clip clip;
  clip.name = "lowered";
  clip.end = float(kFrames - 1) / clip.framesPerSecond;
  JointTracks arm{
      .joint = body.skeleton.find("leftUpperArm"), .translation = {}, .rotation = {}, .scale = {}};
  for (int f = 0; f < kFrames; ++f) {
    const float share = std::sin(kPi * float(f) / float(kFrames - 1));
    arm.rotation.times.push_back(clip.timeOfFrame(std::uint32_t(f)));
    arm.rotation.values.push_back(glm::angleAxis(-glm::radians(degrees * share), vec3(0, 0, 1)));
  }
  clip.tracks.push_back(arm);
  return clip;
}

// How deep the skin of lower arm and hand lies in that of trunk and legs, as the pose has both [m].
float depthIn(const Body& body, const Clip& clip, std::uint32_t frame) {
  const SkinnedMesh& skin = body.meshes[0];
  const auto onArm = [&](std::uint32_t v, bool lower) {
    float share = 0;
    for (int k = 0; k < 4; ++k) {
      const std::string& name = body.skeleton.joints[skin.influences[v].joints[std::size_t(k)]].name;
      if (name.ends_with("LowerArm") || name.ends_with("Hand") || (!lower && name.ends_with("UpperArm")))
        share += skin.influences[v].weights[k];
    }
    return share > 0.5f;
  };
  TriangleMesh trunk = skin.mesh;
  skinPositions(skin, skinMatrices(body.skeleton, samplePose(body.skeleton, clip, clip.timeOfFrame(frame))),
                trunk.positions);
  std::erase_if(trunk.triangles, [&](const uvec3& t) { return onArm(t.x, false); });
  const TriangleTree tree(trunk);
  const WindingNumber winding(trunk.positions, trunk.triangles);
  float depth = 0;
  for (std::uint32_t v = 0; v < trunk.positions.size(); ++v)
    if (onArm(v, true) && winding.at(trunk.positions[v]) > 0.5f)
      depth = std::max(depth, tree.nearest(trunk.positions[v]).distance);
  return depth;
}

vec3 handIn(const Body& body, const Clip& clip, std::uint32_t frame) {
  const Pose pose = samplePose(body.skeleton, clip, clip.timeOfFrame(frame));
  return vec3(pose.world[body.skeleton.find("leftHand").value][3]);
}

const ClearedArm& left(const std::vector<ClearedArm>& arms) {
  const auto found = std::ranges::find(arms, "leftUpperArm", &ClearedArm::joint);
  REQUIRE(found != arms.end());
  return *found;
}

}  // namespace

TEST_CASE("clearance: an arm that is lowered through the hip stays beside it") {
  const Body body = person();
  Clip given = lowered(body, kThrough), clip = given;
  REQUIRE(depthIn(body, given, kFrames / 2) > 0.03f);
  const auto told = left(keepArmsClear(body, {&clip, 1}));
  MESSAGE(told.frames << " frames, " << 1000 * told.before << " -> " << 1000 * told.after << " mm, "
                      << glm::degrees(told.turn) << " degrees");
  CHECK(told.clip == "lowered");
  CHECK(told.before == doctest::Approx(depthIn(body, given, kFrames / 2)).epsilon(0.3));
  CHECK(told.left == 0);
  CHECK(told.after <= kFleshGives);
  CHECK(told.turn < glm::radians(20.0f));
  float most = 0, mostGiven = 0;
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    CHECK(depthIn(body, clip, f) <= 2 * kFleshGives);  // between the places that are looked at, too
    if (f == 0) continue;
    most = std::max(most, glm::distance(handIn(body, clip, f), handIn(body, clip, f - 1)));
    mostGiven = std::max(mostGiven, glm::distance(handIn(body, given, f), handIn(body, given, f - 1)));
  }
  CHECK(most < 1.1f * mostGiven);  // it is led around, without a jump
  // The way there and back is the same, and far from the body it is what it was.
  for (std::uint32_t f = 0; f < kFrames; ++f)
    CHECK(glm::distance(handIn(body, clip, f), handIn(body, clip, kFrames - 1 - f)) < 2e-3f);
  CHECK(glm::distance(handIn(body, clip, 3), handIn(body, given, 3)) < 1e-5f);
  CHECK(glm::distance(handIn(body, clip, kFrames / 2), handIn(body, given, kFrames / 2)) > 0.03f);
}

TEST_CASE("clearance: what keeps clear is left as it is, to the bit") {
  const Body body = person();
  const Clip given = lowered(body, kClear);
  Clip clip = given;
  for (const ClearedArm& arm : keepArmsClear(body, {&clip, 1})) {
    CHECK(arm.frames == 0);
    CHECK(arm.turn == 0);
  }
  REQUIRE(clip.tracks.size() == 1);
  CHECK(clip.tracks[0].rotation.values == given.tracks[0].rotation.values);
  CHECK(clip.tracks[0].rotation.times == given.tracks[0].rotation.times);
}

TEST_CASE("clearance: a way that no half radian clears is told") {
  const Body body = person();
  Clip clip = lowered(body, 120);
  const auto told = left(keepArmsClear(body, {&clip, 1}));
  CHECK(told.left > 0);
  CHECK(told.after > kFleshGives);
  CHECK(told.turn < 0.51f);
}

TEST_CASE("clearance: a clip that goes round does so still") {
  const Body body = person();
  Clip clip = lowered(body, kThrough);
  // Begun where it is deepest.
  auto& turns = clip.tracks[0].rotation.values;
  turns.pop_back();
  std::rotate(turns.begin(), turns.begin() + kFrames / 2, turns.end());
  turns.push_back(turns.front());
  REQUIRE(closes(body.skeleton, clip));
  CHECK(left(keepArmsClear(body, {&clip, 1})).left == 0);
  CHECK(closes(body.skeleton, clip));
  CHECK(glm::distance(handIn(body, clip, 0), handIn(body, clip, kFrames - 2)) < 0.02f);
}

TEST_CASE("clearance: a body without a skin, and one without arms, stay as they are") {
  Body bare = person();
  Clip clip = lowered(bare, kThrough);
  bare.meshes.clear();
  CHECK(keepArmsClear(bare, {&clip, 1}).empty());
  Body nameless = person();
  for (auto& joint : nameless.skeleton.joints) joint.name = "joint", joint.parent = {};
  CHECK(keepArmsClear(nameless, {&clip, 1}).empty());
}
