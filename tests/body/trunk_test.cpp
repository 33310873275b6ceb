#include "body/trunk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "body/motion_rest.h"
#include "body/retarget.h"

using namespace vasa;

namespace {

// How a program names a person: the trunk from hips to head, then of a side collar, arm and leg; @ stands for
// Left, $ for L, % for l.
struct Scheme {
  const char* name;
  std::vector<std::string> trunk, side;
};
const std::vector<std::string> kCmuSide{"@Shoulder", "@Arm", "@ForeArm", "@Hand", "@UpLeg", "@Leg", "@Foot"};
const Scheme kCmu{"cmu", {"Hips", "LowerBack", "Spine", "Spine1", "Neck", "Head"}, kCmuSide};
const std::vector<Scheme> kSchemes{
    {"hybrid",
     {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head"},
     {"@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip", "@Knee", "@Ankle"}},
    {"xsens",
     {"Pelvis", "L5", "L3", "T8", "Neck", "Head"},
     {"@Shoulder", "@UpperArm", "@Forearm", "@Hand", "@UpperLeg", "@LowerLeg", "@Foot"}},
    {"advanced skeleton",
     {"Root_M", "Spine1_M", "Spine2_M", "Chest_M", "Neck_M", "Head_M"},
     {"Scapula_$", "Shoulder_$", "Elbow_$", "Wrist_$", "Hip_$", "Knee_$", "Ankle_$"}},
    {"metarig",
     {"spine", "spine.001", "spine.002", "spine.003", "spine.004", "spine.005"},
     {"shoulder.$", "upper_arm.$", "forearm.$", "hand.$", "thigh.$", "shin.$", "foot.$"}},
    {"opensim",
     {"pelvis", "lumbar_body", "thorax", "torso", "neck", "head"},
     {"clavicle_%", "humerus_%", "ulna_%", "hand_%", "femur_%", "tibia_%", "talus_%"}},
    {"trunk unknown", {"pelvis", "x1", "x2", "x3", "x4", "x5"}, kCmuSide}};

// The same scheme with another number of joints in the trunk, whose names tell nothing.
Scheme withSpine(std::size_t count) {
  Scheme scheme{"", {"Hips"}, kCmuSide};
  for (std::size_t i = 0; i < count; ++i) scheme.trunk.push_back("v" + std::to_string(i));
  scheme.trunk.push_back("Neck"), scheme.trunk.push_back("Head");
  return scheme;
}

std::string onSide(const std::string& pattern, bool left) {
  std::string name;
  for (const char c : pattern)
    if (c == '@')
      name += left ? "Left" : "Right";
    else if (c == '$')
      name += left ? "L" : "R";
    else if (c == '%')
      name += left ? "l" : "r";
    else
      name += c;
  return name;
}

struct Figure {
  std::vector<std::string> names;
  std::vector<int> parents;
  std::vector<vec3> places;
  std::size_t spine = 0;  // joints 1 to this
  int neck() const { return int(spine) + 1; }
  // Joints at the ends of a limb's bones, of the same limbs for any spine.
  std::vector<std::pair<int, int>> bones() const {
    std::vector<std::pair<int, int>> all;
    for (const int side : {neck() + 2, neck() + 9})
      for (const int bone : {1, 2, 4, 5}) all.push_back({side + bone, side + bone + 1});
    return all;
  }
};

// In a T pose; the spine's joints evenly along nine tenths of the way from hips to neck.
Figure figureOf(const Scheme& scheme) {
  Figure figure;
  figure.spine = scheme.trunk.size() - 3;
  const auto add = [&](const std::string& name, int parent, vec3 place) {
    figure.names.push_back(name), figure.parents.push_back(parent), figure.places.push_back(place);
    return int(figure.names.size()) - 1;
  };
  int top = add(scheme.trunk[0], -1, {0, 0.95f, 0});
  for (std::size_t i = 0; i < figure.spine; ++i)
    top = add(scheme.trunk[i + 1], top, {0, 1 + 0.45f * float(i) / float(figure.spine), 0});
  const int neck = add(scheme.trunk[figure.spine + 1], top, {0, 1.45f, 0});
  add(scheme.trunk[figure.spine + 2], neck, {0, 1.55f, 0});
  for (const bool left : {true, false}) {
    const float side = left ? 1.0f : -1.0f;
    int before = top;
    const auto next = [&](std::size_t i, float x, float y, float z) {
      before = add(onSide(scheme.side[i], left), before, {side * x, y, z});
    };
    next(0, 0.04f, 1.4f, 0), next(1, 0.18f, 1.4f, 0), next(2, 0.46f, 1.4f, 0), next(3, 0.71f, 1.4f, 0);
    before = 0;
    next(4, 0.09f, 0.9f, 0), next(5, 0.09f, 0.5f, 0), next(6, 0.09f, 0.08f, 0.03f);
  }
  return figure;
}

Body bodyOf(const Figure& figure) {
  Body body;
  body.name = "figure.glb";
  for (std::size_t i = 0; i < figure.names.size(); ++i) {
    Skeleton::Joint joint;
    joint.name = figure.names[i];
    joint.rest.translation = figure.places[i];
    if (figure.parents[i] >= 0) {
      joint.parent = {std::uint32_t(figure.parents[i])};
      joint.rest.translation -= figure.places[std::size_t(figure.parents[i])];
    }
    joint.restWorld = glm::translate(mat4(1), figure.places[i]);
    joint.inverseBind = glm::inverse(joint.restWorld);
    body.skeleton.joints.push_back(joint);
  }
  return body;
}

constexpr std::uint32_t kBendFrames = 13;
constexpr float kMostBend = 70 * kPi / 180;

// Bends forward and aside, evenly over the spine's joints, while it turns, arms lift and knees bend.
Motion bending(const Figure& figure) {
  Motion motion = standingStill(bodyOf(figure));
  motion.name = "bend.bvh";
  const std::vector<vec3> offsets = motion.translations;
  motion.rotations.clear(), motion.translations.clear();
  motion.frameCount = kBendFrames;
  for (std::uint32_t frame = 0; frame < kBendFrames; ++frame) {
    const float t = float(frame) / (kBendFrames - 1);
    std::vector<quat> turns(figure.names.size(), quat(1, 0, 0, 0));
    turns[0] = glm::angleAxis(0.4f * t, vec3(0, 1, 0));
    for (std::size_t i = 0; i < figure.spine; ++i)
      turns[i + 1] = glm::angleAxis(kMostBend * t / float(figure.spine), glm::normalize(vec3(1, 0, 0.3f)));
    for (const int side : {figure.neck() + 2, figure.neck() + 9}) {
      turns[std::size_t(side) + 1] = glm::angleAxis(0.7f * t, vec3(0, 0, 1));
      turns[std::size_t(side) + 2] = glm::angleAxis(0.9f * t, vec3(0, 1, 0));
      turns[std::size_t(side) + 5] = glm::angleAxis(0.5f * t, vec3(1, 0, 0));
    }
    motion.rotations.insert(motion.rotations.end(), turns.begin(), turns.end());
    motion.translations.insert(motion.translations.end(), offsets.begin(), offsets.end());
  }
  return motion;
}

float degrees(vec3 a, vec3 b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0f, 1.0f)) * 180 / kPi;
}

struct Angles {
  float limbs = 0, trunk = 0;
};
// The largest ones between both in any frame.
Angles anglesBetween(const Figure& from, const Motion& motion, const Figure& to, const Clip& clip) {
  Angles worst;
  const Body body = bodyOf(to);
  for (std::uint32_t frame = 0; frame < kBendFrames; ++frame) {
    const MotionPose theirs = motionPose(motion, frame);
    const Pose own = samplePose(body.skeleton, clip, clip.timeOfFrame(frame));
    const auto way = [&](int a, int b) {
      return vec3(own.world[std::size_t(b)][3] - own.world[std::size_t(a)][3]);
    };
    const auto wanted = [&](int a, int b) {
      return theirs.places[std::size_t(b)] - theirs.places[std::size_t(a)];
    };
    worst.trunk = std::max(worst.trunk, degrees(way(0, to.neck()), wanted(0, from.neck())));
    const auto bones = to.bones(), others = from.bones();
    for (std::size_t i = 0; i < bones.size(); ++i)
      worst.limbs = std::max(worst.limbs, degrees(way(bones[i].first, bones[i].second),
                                                  wanted(others[i].first, others[i].second)));
  }
  return worst;
}

void checkFollowed(const Scheme& from, const Scheme& to) {
  const Figure theirs = figureOf(from), own = figureOf(to);
  const Motion motion = bending(theirs);
  const auto done = retargeted(motion, bodyOf(own));
  if (!done.ok()) FAIL(done.error().message);
  const Angles angles = anglesBetween(theirs, motion, own, done->clip);
  const std::string what = std::string(from.name) + " " + std::to_string(theirs.spine) + " on " + to.name +
                           " " + std::to_string(own.spine) + ": limbs " + std::to_string(angles.limbs) +
                           ", trunk " + std::to_string(angles.trunk) + "; " + describeMatch(*done);
  CHECK_MESSAGE(angles.limbs < 10, what);
  CHECK_MESSAGE(angles.trunk < 10, what);
  CHECK_MESSAGE(done->keys == kHumanoidKeys, what);
  CHECK_MESSAGE(done->sureness > 0.9f, what);
  CHECK_MESSAGE(describeMatch(*done).find("trunk") == std::string::npos, what);
  if (own.spine == theirs.spine)
    for (std::uint32_t j = 0; j <= own.spine + 2; ++j) CHECK_MESSAGE(done->source[j] == j, what);
}

}  // namespace

TEST_CASE("a trunk is followed whatever its joints are called, by motions and by bodies") {
  for (const Scheme& scheme : kSchemes) checkFollowed(scheme, kCmu), checkFollowed(kCmu, scheme);
}

TEST_CASE("bodies are paired joint for joint in whatever their trunks are called, as vessels are carried") {
  for (const Scheme& scheme : kSchemes) {
    const Body from = bodyOf(figureOf(kCmu)), to = bodyOf(figureOf(scheme));
    const auto pairs = matchedJoints(standingStill(to), from);
    REQUIRE(pairs.ok());
    for (std::uint32_t j = 0; j < pairs->source.size(); ++j)
      CHECK_MESSAGE(pairs->source[j] == j, scheme.name << ": " << from.skeleton.joints[j].name);
  }
}

TEST_CASE("trunks of one to five joints bend as one another") {
  for (const std::size_t many : {1u, 2u, 3u, 5u})
    for (const std::size_t other : {1u, 3u})
      checkFollowed(withSpine(many), withSpine(other)), checkFollowed(withSpine(other), withSpine(many));
}

TEST_CASE("what a motion bends in one joint, a body with three bends in more than one") {
  const Body body = bodyOf(figureOf(withSpine(3)));
  const auto done = retargeted(bending(figureOf(withSpine(1))), body);
  REQUIRE(done.ok());
  const Pose pose = samplePose(body.skeleton, done->clip, done->clip.end);
  for (std::size_t j = 1; j <= 3; ++j) {
    const quat bend = glm::conjugate(rotationOf(pose.world[j - 1])) * rotationOf(pose.world[j]);
    CHECK(std::abs(glm::angle(bend)) < 0.75f * kMostBend);
  }
}

TEST_CASE("a trunk that cannot bend is told, and makes a match less sure") {
  const auto done = retargeted(bending(figureOf(kCmu)), bodyOf(figureOf(withSpine(0))));
  REQUIRE(done.ok());
  CHECK_MESSAGE(describeMatch(*done).find("trunk: not followed") != std::string::npos, describeMatch(*done));
  CHECK(done->sureness == doctest::Approx(0.8f));
}

TEST_CASE("a map has its way in a trunk that is paired by its order, and in one that takes shares") {
  for (const std::size_t own : {3u, 2u}) {
    const Motion motion = bending(figureOf(withSpine(3)));
    const Body body = bodyOf(figureOf(withSpine(own)));
    const auto pairs = matchedJoints(motion, body, {{"v0", "v1"}, {"v1", ""}});
    REQUIRE(pairs.ok());
    CHECK(pairs->source[2] == 1);
    CHECK(std::ranges::find(pairs->source, 2u) == pairs->source.end());
    for (const TrunkShare& share : pairs->spread.shares) {
      CHECK(share.joint == 1);
      CHECK(share.low != 2);
      CHECK(share.high != 2);
    }
  }
}

TEST_CASE("a trunk is what lies between hips and neck, wherever the arms and the hips hang") {
  Rig rig;
  const auto add = [&](const char* name, std::uint32_t parent, vec3 place, const char* part) {
    rig.names.emplace_back(name), rig.parents.push_back(parent);
    rig.centres.push_back(place), rig.tips.push_back(place);
    rig.parts.of.push_back(humanoidPart(part));
  };
  add("root", JointId::kNone, {0, 1, 0}, "");
  add("pelvis", 0, {0, 1, 0}, "hips");
  add("a", 0, {0, 1.1f, 0}, "");
  add("b", 2, {0, 1.3f, 0}, "");
  add("left", 3, {0.2f, 1.4f, 0}, "leftUpperArm");
  add("right", 3, {-0.2f, 1.4f, 0}, "rightUpperArm");
  Trunk trunk = findTrunk(rig);
  CHECK(trunk.joints == std::vector<std::uint32_t>{2, 3});
  CHECK(trunk.ends == std::vector<std::uint32_t>{4, 5});
  CHECK(trunk.shares[0] == doctest::Approx(0.25f));
  CHECK(trunk.shares[1] == doctest::Approx(0.75f));
  add("c", 3, {0, 1.35f, 0}, "");
  add("top", 6, {0, 1.5f, 0}, "neck");
  trunk = findTrunk(rig);
  CHECK(trunk.joints == std::vector<std::uint32_t>{2, 3, 6});
  CHECK(trunk.ends == std::vector<std::uint32_t>{7});
  nameTrunk(rig);
  CHECK(rig.parts.of[2] == "spine");
  CHECK(rig.parts.of[3] == "chest");
  CHECK(rig.parts.of[6] == "upperChest");
  rig.parts.of[1] = {};
  CHECK(!findTrunk(rig).known());
}
