#include "body/rig.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body/humanoid_shape.h"
#include "body/trunk.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kLongBone = 2.5f;  // times the other bone of a limb: no person's
// The same where only the shape told which bones these are: three spreads from a person's
// (body/humanoid_shape.cpp), as of a collar bone taken for an upper arm.
constexpr float kUnlikelyBone = 1.7f;
constexpr float kShortArm = 0.4f, kLongArm = 1.2f;  // of a leg, without hand and foot
constexpr int kGross = 8;                           // what no person has counts as much as this many doubts
constexpr std::size_t kMostTops = 64, kMostAsked = 2000;  // trees, and joints, that are looked at for people
constexpr int kMostAbove = 8;                             // nodes one above the other above these trees
constexpr float kAlike = 0.25f;  // the share by which the bones of both sides may differ

// Names first; where these tell little, the skeleton's shape.
void nameParts(Rig& rig) {
  rig.parts = humanoidNames(rig.names);
  nameTrunk(rig);
  if (humanoidKeys(rig.parts.of) >= kHumanoidKeys / 2) return;
  HumanoidNames names{"shape", humanoidShape(rig.parents, rig.centres, rig.tips)};
  std::swap(rig.parts, names);
  nameTrunk(rig);
  if (humanoidKeys(rig.parts.of) <= humanoidKeys(names.of)) rig.parts = std::move(names);
}

}  // namespace

std::uint32_t Rig::limbEnd(std::string_view part) const {
  for (const auto& [own, behind] : {std::pair{"UpperArm", "LowerArm"},
                                    {"LowerArm", "Hand"},
                                    {"UpperLeg", "LowerLeg"},
                                    {"LowerLeg", "Foot"}})
    if (part.ends_with(own))
      return partNamed(std::string(part.starts_with("left") ? "left" : "right") + behind);
  return kNone;
}

bool isLowerBone(std::string_view part) { return part.ends_with("LowerArm") || part.ends_with("LowerLeg"); }

std::optional<vec3> Rig::boneEnd(std::uint32_t joint, std::string_view part, std::span<const vec3> places,
                                 std::span<const vec3> ends) const {
  if (const std::uint32_t end = limbEnd(part); end != kNone) return places[end];
  if (!isLowerBone(part) || ends[joint] == places[joint]) return std::nullopt;
  return ends[joint];
}

void placeIn(Rig& rig, const MotionPose& pose) { rig.centres = pose.places, rig.tips = pose.tips; }

Rig rigOf(const Motion& motion) {
  Rig rig;
  for (const Motion::Joint& joint : motion.joints)
    rig.names.push_back(joint.name), rig.parents.push_back(joint.parent.value);
  placeIn(rig, motionPose(motion, 0));
  nameParts(rig);
  return rig;
}

Rig rigOf(const Skeleton& skeleton) {
  Rig rig;
  for (const auto& joint : skeleton.joints) {
    rig.names.push_back(joint.name);
    rig.parents.push_back(joint.parent.value);
    rig.centres.push_back(vec3(joint.restWorld[3]));
  }
  rig.tips = rig.centres;
  nameParts(rig);
  return rig;
}

std::size_t peopleIn(const Skeleton& skeleton) {
  constexpr int kLeastKeys = kHumanoidKeys - 2;
  const auto& joints = skeleton.joints;
  if (joints.size() > kMostAsked) return 0;
  const auto isPerson = [&](std::uint32_t top) {
    std::vector<bool> tree(joints.size(), false);
    tree[top] = true;
    for (std::size_t j = top + 1; j < joints.size(); ++j)
      tree[j] = joints[j].parent.valid() && tree[joints[j].parent.value];
    return std::ranges::count(tree, true) >= kLeastKeys &&
           humanoidKeys(rigOf(keepJoints(skeleton, tree).skeleton).parts.of) >= kLeastKeys;
  };
  // What stands alone at the top may be a node above several.
  std::size_t most = 0;
  JointId above;
  for (int depth = 0; depth < kMostAbove; ++depth) {
    std::vector<std::uint32_t> tops;
    for (std::uint32_t j = 0; j < joints.size(); ++j)
      if (joints[j].parent == above) tops.push_back(j);
    if (tops.size() <= kMostTops) most = std::max(most, std::size_t(std::ranges::count_if(tops, isPerson)));
    if (tops.size() != 1) break;
    above = {tops[0]};
  }
  return most;
}

std::optional<mat3> trunkOf(const Rig& rig, std::initializer_list<std::string_view> pairs) {
  const std::uint32_t from = rig.partNamed("hips");
  std::uint32_t to = kNone;
  for (const char* part : {"neck", "head", "upperChest", "chest"})
    if (to == kNone) to = rig.partNamed(part);
  vec3 left(0);
  for (const std::string_view pair : pairs) {
    const std::uint32_t a = rig.partNamed("left" + std::string(pair)),
                        b = rig.partNamed("right" + std::string(pair));
    if (a != kNone && b != kNone) left += rig.centres[a] - rig.centres[b];
  }
  if (from == kNone || to == kNone) return std::nullopt;
  const vec3 up = directionOf(rig.centres[to] - rig.centres[from]),
             side = directionOf(left - glm::dot(left, up) * up);
  if (up == vec3(0) || side == vec3(0)) return std::nullopt;
  return mat3(side, up, glm::cross(side, up));
}

std::size_t peopleMoved(const Motion& motion) {
  Skeleton skeleton;
  const MotionPose pose = motionPose(motion, 0);
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    Skeleton::Joint joint;
    joint.name = motion.joints[j].name, joint.parent = motion.joints[j].parent;
    joint.restWorld[3] = vec4(pose.places[j], 1);
    skeleton.joints.push_back(std::move(joint));
  }
  return peopleIn(skeleton);
}

bool sidesSwapped(const Rig& rig) {
  constexpr float kBackwards = -0.5f;  // cosine; feet that hang down are about 0
  const auto trunk = trunkOf(rig, {"UpperArm", "UpperLeg"});
  vec3 feet(0);
  for (const std::string side : {"left", "right"}) {
    const std::uint32_t foot = rig.partNamed(side + "Foot"), toes = rig.partNamed(side + "Toes");
    if (foot != kNone && toes != kNone) feet += directionOf(rig.centres[toes] - rig.centres[foot]);
  }
  return trunk && glm::dot((*trunk)[2], directionOf(feet)) < kBackwards;
}

float legsOf(const Rig& rig) {
  float length = 0;
  for (const std::string side : {"left", "right"}) {
    const std::uint32_t thigh = rig.partNamed(side + "UpperLeg"), knee = rig.partNamed(side + "LowerLeg"),
                        foot = rig.partNamed(side + "Foot");
    if (thigh == kNone || knee == kNone || foot == kNone) return 0;
    length += glm::distance(rig.centres[thigh], rig.centres[knee]) +
              glm::distance(rig.centres[knee], rig.centres[foot]);
  }
  return length;
}

float extentOf(const Rig& rig) {
  float low = rig.tips[0].y, high = low;
  for (const vec3& p : rig.tips) low = std::min(low, p.y), high = std::max(high, p.y);
  return high - low;
}

float plausibility(const Rig& rig) {
  int held = 0, asked = 0;
  float arm = 0, leg = 0;
  const auto ask = [&](bool holds, int weight = 1) { asked += weight, held += holds ? weight : 0; };
  const auto below = [&](std::uint32_t joint, std::uint32_t above) {
    return hangsOn(rig.parents, joint, above);
  };
  const auto part = [&](const char* side, const char* name) {
    return rig.partNamed(std::string(side) + name);
  };
  const float longBone = rig.parts.family == "shape" ? kUnlikelyBone : kLongBone;
  const std::uint32_t hips = rig.partNamed("hips"),
                      top = rig.partNamed(rig.partNamed("neck") == kNone ? "head" : "neck");
  for (const auto& limb :
       {std::array{"UpperArm", "LowerArm", "Hand"}, std::array{"UpperLeg", "LowerLeg", "Foot"}}) {
    std::array<float, 2> lengths[2] = {{0, 0}, {0, 0}};
    for (int s = 0; s < 2; ++s)
      for (std::size_t k = 0; k < 2; ++k) {
        const char* side = s ? "right" : "left";
        const std::uint32_t a = part(side, limb[k]), b = part(side, limb[k + 1]);
        if (a == kNone || b == kNone) continue;
        ask(below(b, a) && a != b);
        const vec3 bone = rig.centres[b] - rig.centres[a];
        lengths[k][std::size_t(s)] = glm::length(bone);
        if (limb[0] == std::string_view("UpperLeg") && hips != kNone && top != kNone)
          ask(glm::dot(bone, rig.centres[top] - rig.centres[hips]) < 0);
      }
    for (int s = 0; s < 2; ++s) {
      const float upper = lengths[0][std::size_t(s)], lower = lengths[1][std::size_t(s)];
      if (upper > 0 && lower > 0) ask(upper < longBone * lower && lower < longBone * upper, kGross);
      (limb[0] == std::string_view("UpperArm") ? arm : leg) += upper > 0 && lower > 0 ? upper + lower : 0;
    }
    for (const auto& [left, right] :
         {std::pair(lengths[0][0], lengths[0][1]), std::pair(lengths[1][0], lengths[1][1])})
      if (left > 0 && right > 0) ask(std::abs(left - right) < kAlike * std::max(left, right));
    const std::uint32_t l = part("left", limb[0]), r = part("right", limb[0]);
    if (l != kNone && r != kNone) ask(!below(l, r) && !below(r, l));
  }
  if (arm > 0 && leg > 0) ask(arm > kShortArm * leg && arm < kLongArm * leg, kGross);
  return asked > 0 ? float(held) / float(asked) : 1.0f;
}

}  // namespace vasa
