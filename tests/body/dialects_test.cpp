#include <doctest/doctest.h>

#include <algorithm>

#include "body/doll.h"
#include "body/motion_rest.h"
#include "body/motion_units.h"
#include "body/retarget.h"
#include "body/rig.h"
#include "io/bvh.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr const char* kLimbs[] = {"leftUpperArm",  "leftLowerArm",  "leftUpperLeg",  "leftLowerLeg",
                                  "leftFoot",      "rightUpperArm", "rightLowerArm", "rightUpperLeg",
                                  "rightLowerLeg", "rightFoot"};

std::uint32_t jointOf(const Body& body, const std::string& part, const std::string& family) {
  return body.skeleton.find(dollName(part, family)).value;
}

// The largest angle [degrees] between a limb of the body and the performance's, in every frame.
// @param laid  turns the performance
float worstAngle(const Body& body, const Clip& clip, const std::string& family,
                 const quat& laid = {1, 0, 0, 0}) {
  float worst = 0;
  const auto& parts = dollParts();
  for (int frame = 0; frame < kDollFrames; ++frame) {
    const Pose pose = samplePose(body.skeleton, clip, clip.timeOfFrame(std::uint32_t(frame)));
    for (const std::string limb : kLimbs)
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].parent < 0 || parts[std::size_t(parts[i].parent)].part != limb || parts[i].part.empty())
          continue;
        const vec3 from(pose.world[jointOf(body, limb, family)][3]),
            to(pose.world[jointOf(body, parts[i].part, family)][3]);
        worst = std::max(
            worst, std::acos(std::clamp(
                       glm::dot(glm::normalize(to - from), laid * dollDirection(limb, frame)), -1.0f, 1.0f)) *
                       180 / kPi);
      }
  }
  return worst;
}

Retargeting carried(const DollDialect& dialect, const Body& body) {
  const auto motion = parseBvh(dollMotion(dialect), "doll.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  auto done = retargeted(*motion, body);
  if (!done.ok()) FAIL(done.error().message);
  return std::move(*done);
}

}  // namespace

TEST_CASE("motions in others' dialects move a body's limbs as theirs: names, zero poses, units, axes") {
  using Zero = DollDialect::Zero;
  const Body body = dollBody("cmu");
  for (const char* family : {"cmu", "biovision", "mixamo", "vrm", "makehuman", "bip", "daz", "smpl",
                             "prefixed", "asf", "motive", "kinect", "rigify", "numbered"})
    for (const Zero zero : {Zero::t, Zero::a, Zero::i, Zero::oneAxis, Zero::toesHang}) {
      const Retargeting done = carried({family, zero, 100, false, false}, body);
      const std::string what =
          std::string(family) + " " + std::to_string(int(zero)) + ": " + describeMatch(done);
      CHECK_MESSAGE(worstAngle(body, done.clip, "cmu") < 10, what);
      CHECK_MESSAGE(done.keys == kHumanoidKeys, what);
      CHECK_MESSAGE(done.sureness >= 0.75f, what);
      CHECK((done.standingFrame == Retargeting::kZeroPose) == (zero != Zero::oneAxis));
    }
  for (const double units : {1.0, 100.0, 39.37, 1000.0})
    for (const Zero zero : {Zero::t, Zero::oneAxis})
      for (const auto& [zUp, rootTurns] :
           {std::pair(false, false), std::pair(true, false), std::pair(false, true)}) {
        const Retargeting done = carried({"biovision", zero, units, zUp, rootTurns}, body);
        CHECK_MESSAGE(worstAngle(body, done.clip, "cmu") < 10, describeMatch(done));
        CHECK(done.up == (zUp || rootTurns ? vec3(0, 0, 1) : vec3(0, 1, 0)));
        // The way of the hips is the performer's, who is as tall.
        const Pose first = samplePose(body.skeleton, done.clip, 0),
                   last = samplePose(body.skeleton, done.clip, done.clip.end);
        const vec3 way = vec3(last.world[0][3] - first.world[0][3]);
        CHECK(glm::distance(way, vec3(0.02f, 0, 0.03f) * float(kDollFrames - 1)) < 0.03f);
        CHECK(std::abs(
                  metresAUnit(
                      *parseBvh(dollMotion({"biovision", zero, units, zUp, rootTurns}, 2), "x"),
                      partsOf(*parseBvh(dollMotion({"biovision", zero, units, zUp, rootTurns}, 2), "x")).of) *
                      units -
                  1) < 0.01);
      }
}

TEST_CASE("sides that are swapped are told by the feet, whatever names say them and wherever a body faces") {
  for (const char* family : {"cmu", "mixamo", "bip", "daz", "rigify", "vrm"}) {
    CAPTURE(std::string(family));
    Skeleton skeleton = dollBody(family).skeleton;
    CHECK(!sidesSwapped(rigOf(skeleton)));
    Skeleton turned = skeleton;
    for (auto& joint : turned.joints) joint.restWorld[3] *= vec4(-1, 1, -1, 1);
    CHECK(!sidesSwapped(rigOf(turned)));
    for (auto& joint : skeleton.joints) joint.restWorld[3].x *= -1;
    CHECK(sidesSwapped(rigOf(skeleton)));
  }
}

TEST_CASE("who lies or crawls all the time stays down: the zero pose and the hips' height tell what is up") {
  using Zero = DollDialect::Zero;
  const Body body = dollBody("cmu");
  for (const char* family : {"cmu", "numbered"})
    for (const Zero zero : {Zero::t, Zero::i, Zero::oneAxis})
      for (const float degrees : {85.0f, -90.0f})                          // prone, supine
        for (const vec3 way : {vec3(0), vec3(0, 0, 1), vec3(0, 0, -1)}) {  // in place, head or feet first
          auto motion = parseBvh(dollMotion({family, zero, 100, false, false}), "doll.bvh");
          REQUIRE(motion.ok());
          const quat laid = glm::angleAxis(degrees * kPi / 180, vec3(1, 0, 0));
          const std::size_t joints = motion->joints.size();
          for (std::size_t frame = 0; frame < motion->frameCount; ++frame) {
            quat& root = motion->rotations[frame * joints];
            root = laid * root;
            motion->translations[frame * joints] =
                100.0f * (vec3(0, 0.3f, 0) + 1.2f * float(frame) / float(kDollFrames) * way);
          }
          const auto done = retargeted(*motion, body);
          if (!done.ok()) FAIL(done.error().message);
          const std::string what = std::string(family) + " " + std::to_string(int(zero)) + " " +
                                   std::to_string(degrees) + " " + std::to_string(way.z) + ": " +
                                   describeMatch(*done);
          CHECK_MESSAGE(done->up == vec3(0, 1, 0), what);
          CHECK_MESSAGE(worstAngle(body, done->clip, "cmu", laid) < 10, what);
        }
}

TEST_CASE("who walks where +Z is up is not lying, wherever that is, though the zero pose stands along +Y") {
  const Body body = dollBody("cmu");
  for (const float from : {-1.0f, 0.0f, 0.2f, 3.0f}) {
    auto motion = parseBvh(dollMotion({"cmu", DollDialect::Zero::t, 100, false, true}), "doll.bvh");
    REQUIRE(motion.ok());
    for (std::size_t frame = 0; frame < motion->frameCount; ++frame)
      motion->translations[frame * motion->joints.size()].y = 100 * (from + 0.03f * float(frame));
    const auto done = retargeted(*motion, body);
    if (!done.ok()) FAIL(done.error().message);
    CHECK_MESSAGE(done->up == vec3(0, 0, 1), from << ": " << describeMatch(*done));
    CHECK_MESSAGE(worstAngle(body, done->clip, "cmu") < 10, from);
  }
}

TEST_CASE("arms whose last joint is the elbow have forearms as far as its End Site") {
  using Zero = DollDialect::Zero;
  using Arms = DollDialect::Arms;
  const Body body = dollBody("cmu");
  for (const char* family : {"cmu", "biovision", "numbered"})
    for (const Zero zero : {Zero::t, Zero::i, Zero::oneAxis}) {
      const Retargeting done =
          carried({.family = family, .zero = zero, .unitsAMetre = 100, .arms = Arms::endAtWrist}, body);
      const std::string what =
          std::string(family) + " " + std::to_string(int(zero)) + ": " + describeMatch(done);
      CHECK_MESSAGE(worstAngle(body, done.clip, "cmu") < 10, what);
      CHECK_MESSAGE(done.keys == kHumanoidKeys - 2, what);
    }
  // Where nothing tells where the forearm ends it goes straight on, also in a body whose elbows are bent at
  // rest, if names tell which joint it is; a shape is doubtful.
  Body bent = body;
  for (const char* name : {"LeftHand", "RightHand"}) {
    Skeleton::Joint& hand = bent.skeleton.joints[bent.skeleton.find(name).value];
    const vec3 straight = hand.rest.translation;
    hand.rest.translation = glm::angleAxis(0.7f, vec3(1, 0, 0)) * straight;
    hand.restWorld[3] += vec4(hand.rest.translation - straight, 0);
    hand.inverseBind = glm::inverse(hand.restWorld);
  }
  for (const Zero zero : {Zero::t, Zero::oneAxis}) {
    const Retargeting named =
        carried({.family = "cmu", .zero = zero, .unitsAMetre = 100, .arms = Arms::endAtElbow}, bent);
    CHECK_MESSAGE(worstAngle(bent, named.clip, "cmu") < 10, describeMatch(named));
  }
  const auto motion = parseBvh(dollMotion({.family = "numbered", .arms = Arms::endAtElbow}), "doll.bvh");
  REQUIRE(motion.ok());
  const auto numbered = retargeted(*motion, body);
  CHECK_MESSAGE(
      (numbered ? numbered->sureness < 0.6f : numbered.error().message.find("% sure") != std::string::npos),
      (numbered ? describeMatch(*numbered) : numbered.error().message));
}

TEST_CASE("a hand that holds a sword has an arm like the other one") {
  const Body body = dollBody("cmu");
  const Retargeting done = carried({.family = "numbered", .unitsAMetre = 100, .sword = true}, body);
  CHECK_MESSAGE(worstAngle(body, done.clip, "cmu") < 10, describeMatch(done));
  CHECK_MESSAGE(done.keys == kHumanoidKeys, describeMatch(done));
}

TEST_CASE("a zero pose that looks aside or back moves a body the same way") {
  const Body body = dollBody("cmu");
  for (const float facing : {90.0f, 180.0f, -90.0f})
    for (const bool zUp : {false, true}) {
      const Retargeting done = carried({"mixamo", DollDialect::Zero::t, 100, zUp, false, facing}, body);
      CHECK_MESSAGE(worstAngle(body, done.clip, "cmu") < 10, describeMatch(done));
      CHECK(done.standingFrame == Retargeting::kZeroPose);
    }
}

TEST_CASE("a zero pose that looks a little aside moves the hips as one that looks ahead") {
  const Body body = dollBody("cmu");
  const auto sideOf = [&](const Retargeting& done) {
    const Pose pose = samplePose(body.skeleton, done.clip, 0.2f);
    const auto at = [&](const char* joint) { return vec3(pose.world[body.skeleton.find(joint).value][3]); };
    return glm::normalize(at("LeftUpLeg") - at("RightUpLeg"));
  };
  const vec3 ahead = sideOf(carried({"mixamo", DollDialect::Zero::t, 100, false, false}, body));
  for (const float facing : {10.0f, 20.0f, -29.0f, 31.0f, 90.0f}) {
    const vec3 aside = sideOf(carried({"mixamo", DollDialect::Zero::t, 100, false, false, facing}, body));
    CHECK(glm::dot(ahead, aside) > std::cos(glm::radians(1.0f)));
  }
}

TEST_CASE("bodies in others' dialects are moved as well, those without names by their shape") {
  for (const char* family : {"vrm", "mixamo", "bip", "daz", "numbered"}) {
    const Body body = dollBody(family);
    const Retargeting done = carried({"smpl", DollDialect::Zero::oneAxis, 1, true, false}, body);
    CHECK_MESSAGE(worstAngle(body, done.clip, family) < 10, describeMatch(done));
  }
}

namespace {

// A body whose limbs are divided by joints that only twist them, with a knee cap beside each shin, all of
// them numbered.
Body divided(const Body& body) {
  Body out;
  out.name = "divided.glb";
  std::vector<JointId> now(body.skeleton.joints.size());
  const auto add = [&](JointId parent, vec3 place) {
    Skeleton::Joint joint;
    joint.name = std::string("b").append(std::to_string(out.skeleton.joints.size()));
    joint.parent = parent;
    joint.rest.translation =
        place - (parent.valid() ? vec3(out.skeleton.joints[parent.value].restWorld[3]) : vec3(0));
    joint.restWorld = glm::translate(mat4(1), place);
    joint.inverseBind = glm::inverse(joint.restWorld);
    out.skeleton.joints.push_back(joint);
    return JointId{std::uint32_t(out.skeleton.joints.size() - 1)};
  };
  const auto is = [&](const Skeleton::Joint& joint, const char* word) {
    return joint.name.find(word) != std::string::npos;
  };
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j) {
    const Skeleton::Joint& joint = body.skeleton.joints[j];
    const vec3 place(joint.restWorld[3]);
    JointId parent;
    if (joint.parent.valid()) {
      parent = now[joint.parent.value];
      const vec3 from(body.skeleton.joints[joint.parent.value].restWorld[3]);
      const int twists = is(joint, "Hand") ? 2 : is(joint, "Lower") || is(joint, "Foot") ? 1 : 0;
      for (int i = 1; i <= twists; ++i)
        parent = add(parent, glm::mix(from, place, float(i) / float(twists + 1)));
    }
    now[j] = add(parent, place);
    if (is(joint, "LowerLeg")) add(parent, place + vec3(0, 0, 0.04f));
  }
  return out;
}

}  // namespace

TEST_CASE("limbs without names are known through joints that only twist them") {
  const Body plain = dollBody("vrm"), body = divided(plain);
  const HumanoidNames parts = partsOf(body.skeleton);
  CHECK(parts.family == "shape");
  for (std::size_t j = 0; j < plain.skeleton.joints.size(); ++j) {
    const auto& joint = plain.skeleton.joints[j];
    const auto found = std::ranges::find(parts.of, joint.name);
    const bool limb =
        joint.name.find("Arm") != joint.name.npos || joint.name.find("Leg") != joint.name.npos ||
        joint.name.find("Hand") != joint.name.npos || joint.name.find("Foot") != joint.name.npos;
    if (!limb) continue;
    REQUIRE_MESSAGE(found != parts.of.end(), joint.name);
    const vec3 place(body.skeleton.joints[std::size_t(found - parts.of.begin())].restWorld[3]);
    CHECK_MESSAGE(glm::distance(place, vec3(joint.restWorld[3])) < 1e-4f, joint.name);
  }
  const Retargeting done = carried({"smpl", DollDialect::Zero::t, 100, false, false}, body);
  CHECK_MESSAGE(done.sureness > 0.75f, describeMatch(done));
}

TEST_CASE("what fits by few joints is refused with how sure it is and what helps") {
  // Eight joints bear names that are known, at other places: a leg that is an arm folds the body.
  const Body body = dollBody("cmu");
  auto motion = parseBvh(dollMotion({"numbered"}), "doll.bvh");
  REQUIRE(motion.ok());
  const auto rename = [&](const char* part, const char* name) {
    for (auto& joint : motion->joints)
      if (joint.name == dollName(part, "numbered")) joint.name = name;
  };
  for (const auto& [part, name] : {std::pair("hips", "Hips"),
                                   {"spine", "LeftUpLeg"},
                                   {"chest", "LeftLeg"},
                                   {"neck", "LeftFoot"},
                                   {"leftShoulder", "RightUpLeg"},
                                   {"leftUpperArm", "RightLeg"},
                                   {"leftLowerArm", "RightFoot"},
                                   {"rightUpperArm", "Head"}})
    rename(part, name);
  const auto done = retargeted(*motion, body);
  if (done.ok()) FAIL(describeMatch(*done));
  CHECK_MESSAGE(done.error().message.find("% sure") != std::string::npos, done.error().message);
  CHECK(done.error().message.find("vasa map BODY MOTION") != std::string::npos);
}

TEST_CASE("where nobody stands, in the zero pose or any frame, that is said and counts against it") {
  const Body body = dollBody("cmu");
  auto motion = parseBvh(dollMotion({.family = "mixamo", .zero = DollDialect::Zero::oneAxis}), "doll.bvh");
  REQUIRE(motion.ok());
  CHECK(retargeted(*motion, body)->stands);
  for (std::size_t frame = 0; frame < motion->frameCount; ++frame)
    for (std::size_t j = 1; j < motion->joints.size(); ++j) {
      quat& turn = motion->rotations[frame * motion->joints.size() + j];
      turn = turn * glm::angleAxis(1.2f + 0.4f * float(j), glm::normalize(vec3(j % 2, 1, j % 3)));
    }
  const auto done = retargeted(*motion, body);
  const std::string said = done ? describeMatch(*done) : done.error().message;
  CHECK_MESSAGE(said.find("nobody stands") != said.npos, said);
  CHECK_MESSAGE((!done || done->sureness < 0.75f), said);
}
