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

// A limb on the left is turned down or inwards and back again.
Clip turned(const Body& body, const char* joint, float degrees) {
  Clip clip;
  clip.name = "turned";
  clip.end = float(kFrames - 1) / clip.framesPerSecond;
  JointTracks limb{.joint = body.skeleton.find(joint), .translation = {}, .rotation = {}, .scale = {}};
  for (int f = 0; f < kFrames; ++f) {
    const float share = std::sin(kPi * float(f) / float(kFrames - 1));
    limb.rotation.times.push_back(clip.timeOfFrame(std::uint32_t(f)));
    limb.rotation.values.push_back(glm::angleAxis(-glm::radians(degrees * share), vec3(0, 0, 1)));
  }
  clip.tracks.push_back(limb);
  return clip;
}

// The left arm of a person that holds them aside is lowered and raised again.
Clip lowered(const Body& body, float degrees) { return turned(body, "leftUpperArm", degrees); }

// How deep the skin of one part lies in that of others, as the pose has both [m].
// @param isPart, isOther  of joints' names
template <class IsPart, class IsOther>
float depthIn(const Body& body, const Clip& clip, std::uint32_t frame, const IsPart& isPart,
              const IsOther& isOther) {
  const SkinnedMesh& skin = body.meshes[0];
  const auto follows = [&](std::uint32_t v, const auto& counts) {
    float share = 0;
    for (int k = 0; k < 4; ++k)
      if (counts(body.skeleton.joints[skin.influences[v].joints[std::size_t(k)]].name))
        share += skin.influences[v].weights[k];
    return share > 0.5f;
  };
  TriangleMesh trunk = skin.mesh;
  skinPositions(skin, skinMatrices(body.skeleton, samplePose(body.skeleton, clip, clip.timeOfFrame(frame))),
                trunk.positions);
  std::erase_if(trunk.triangles, [&](const uvec3& t) { return !follows(t.x, isOther); });
  const TriangleTree tree(trunk);
  const WindingNumber winding(trunk.positions, trunk.triangles);
  float depth = 0;
  for (std::uint32_t v = 0; v < trunk.positions.size(); ++v)
    if (follows(v, isPart) && winding.at(trunk.positions[v]) > 0.5f)
      depth = std::max(depth, tree.nearest(trunk.positions[v]).distance);
  return depth;
}

// Of lower arm and hand in trunk and legs.
float depthIn(const Body& body, const Clip& clip, std::uint32_t frame) {
  const auto isLower = [](const std::string& name) {
    return name.ends_with("LowerArm") || name.ends_with("Hand");
  };
  return depthIn(body, clip, frame, isLower,
                 [&](const std::string& name) { return !isLower(name) && !name.ends_with("UpperArm"); });
}

// Of the left lower leg and foot in the right leg.
float depthInLeg(const Body& body, const Clip& clip, std::uint32_t frame) {
  const auto isLower = [](const std::string& name) {
    return name.ends_with("LowerLeg") || name.ends_with("Foot") || name.ends_with("Toes");
  };
  return depthIn(
      body, clip, frame, [&](const std::string& name) { return name.starts_with("left") && isLower(name); },
      [&](const std::string& name) {
        return name.starts_with("right") && (isLower(name) || name.ends_with("UpperLeg"));
      });
}

vec3 handIn(const Body& body, const Clip& clip, std::uint32_t frame) {
  const Pose pose = samplePose(body.skeleton, clip, clip.timeOfFrame(frame));
  return vec3(pose.world[body.skeleton.find("leftHand").value][3]);
}

const ClearedLimb& left(const std::vector<ClearedLimb>& arms) {
  const auto found = std::ranges::find(arms, "leftUpperArm", &ClearedLimb::joint);
  REQUIRE(found != arms.end());
  return *found;
}

}  // namespace

TEST_CASE("clearance: an arm that is lowered through the hip stays beside it") {
  const Body body = person();
  Clip given = lowered(body, kThrough), clip = given;
  REQUIRE(depthIn(body, given, kFrames / 2) > 0.03f);
  const auto told = left(keepLimbsClear(body, {&clip, 1}));
  MESSAGE(told.frames << " frames, " << 1000 * told.before << " -> " << 1000 * told.after << " mm, "
                      << glm::degrees(told.turn) << " degrees");
  CHECK(told.clip == "turned");
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
  for (const ClearedLimb& arm : keepLimbsClear(body, {&clip, 1})) {
    CHECK(arm.frames == 0);
    CHECK(arm.turn == 0);
  }
  REQUIRE(clip.tracks.size() == 1);
  CHECK(clip.tracks[0].rotation.values == given.tracks[0].rotation.values);
  CHECK(clip.tracks[0].rotation.times == given.tracks[0].rotation.times);
}

TEST_CASE("clearance: a leg that swings through the other one goes by beside it, each of them by half") {
  const Body body = person();
  const Clip given = turned(body, "leftUpperLeg", 9);
  Clip clip = given;
  REQUIRE(depthInLeg(body, given, kFrames / 2) > 0.02f);
  const auto told = keepLimbsClear(body, {&clip, 1});
  REQUIRE_FALSE(told.empty());
  const ClearedLimb& legs = told.front();
  MESSAGE(legs.frames << " frames, " << 1000 * legs.before << " -> " << 1000 * legs.after << " mm, "
                      << glm::degrees(legs.turn) << " degrees");
  CHECK(legs.joint == "leftUpperLeg");
  CHECK(legs.other == "rightUpperLeg");
  CHECK(legs.left == 0);
  CHECK(legs.turn > glm::radians(1.0f));
  CHECK(legs.turn < glm::radians(12.0f));
  for (std::uint32_t f = 0; f < kFrames; ++f) CHECK(depthInLeg(body, clip, f) <= 2 * kFleshGives);
  const auto turnOf = [&](const char* joint) {
    const JointId thigh = body.skeleton.find(joint);
    const float time = given.timeOfFrame(kFrames / 2);
    const quat before = rotationOf(samplePose(body.skeleton, given, time).world[thigh.value]);
    return glm::angle(rotationOf(samplePose(body.skeleton, clip, time).world[thigh.value]) *
                      glm::conjugate(before));
  };
  CHECK(turnOf("rightUpperLeg") == doctest::Approx(turnOf("leftUpperLeg")).epsilon(0.2));
  const auto arms = std::ranges::count_if(told, [](const ClearedLimb& limb) { return limb.other.empty(); });
  CHECK(arms == 2);
  // The same the other way round.
  Clip mirrored = turned(body, "rightUpperLeg", -9);
  const ClearedLimb other = keepLimbsClear(body, {&mirrored, 1}).front();
  CHECK(other.left == 0);
  CHECK(other.before == doctest::Approx(legs.before).epsilon(0.05));
  CHECK(other.turn == doctest::Approx(legs.turn).epsilon(0.1));
}

TEST_CASE("clearance: a way that no turn clears is told") {
  const Body body = person();
  Clip clip = lowered(body, 120);
  const auto told = left(keepLimbsClear(body, {&clip, 1}));
  CHECK(told.left > 0);
  CHECK(told.after > kFleshGives);
  CHECK(told.turn < 0.51f);
  Clip crossed = turned(body, "leftUpperLeg", 40);
  const ClearedLimb legs = keepLimbsClear(body, {&crossed, 1}).front();
  CHECK(legs.left > 0);
  CHECK(legs.turn < 0.51f);  // a quarter each at most
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
  CHECK(left(keepLimbsClear(body, {&clip, 1})).left == 0);
  CHECK(closes(body.skeleton, clip));
  CHECK(glm::distance(handIn(body, clip, 0), handIn(body, clip, kFrames - 2)) < 0.02f);
}

TEST_CASE("clearance: a clip that ends between two frames goes round, too") {
  const Body body = person();
  Clip clip = lowered(body, kThrough);
  auto& turns = clip.tracks[0].rotation;
  turns.values.pop_back(), turns.times.pop_back();
  std::rotate(turns.values.begin(), turns.values.begin() + kFrames / 2, turns.values.end());
  clip.end -= 0.4f / clip.framesPerSecond;
  turns.values.push_back(turns.values.front()), turns.times.push_back(clip.end);
  REQUIRE(closes(body.skeleton, clip));
  CHECK(left(keepLimbsClear(body, {&clip, 1})).frames > 0);
  CHECK(closes(body.skeleton, clip));
  CHECK(clip.tracks[0].rotation.times.back() == clip.end);
}

TEST_CASE("clearance: a body without a skin, and one without arms, stay as they are") {
  Body bare = person();
  Clip clip = lowered(bare, kThrough);
  bare.meshes.clear();
  CHECK(keepLimbsClear(bare, {&clip, 1}).empty());
  Body nameless = person();
  for (auto& joint : nameless.skeleton.joints) joint.name = "joint", joint.parent = {};
  CHECK(keepLimbsClear(nameless, {&clip, 1}).empty());
}
