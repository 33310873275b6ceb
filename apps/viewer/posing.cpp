#include "viewer/posing.h"

#include <algorithm>
#include <cmath>

namespace vasa::viewer {
namespace {

constexpr float degrees(float value) {
  return value * kPi / 180;
}

struct Limit {
  std::string_view part;  // of the role
  float most;             // [rad]
};
// The largest range of each joint (AAOS 1965, rounded up), whichever way it goes.
constexpr Limit kLimits[] = {
    {"UpperLeg", degrees(125)}, {"LowerLeg", degrees(145)}, {"Foot", degrees(50)},   {"Toes", degrees(60)},
    {"UpperArm", degrees(150)}, {"LowerArm", degrees(150)}, {"Hand", degrees(85)},   {"Shoulder", degrees(40)},
    {"Thumb", degrees(70)},     {"Index", degrees(100)},    {"Middle", degrees(100)}, {"Ring", degrees(100)},
    {"Little", degrees(100)},   {"head", degrees(50)},      {"neck", degrees(50)},   {"hest", degrees(35)},
    {"spine", degrees(40)},     {"hips", degrees(180)},
};

quat turnOf(vec3 angles) {
  return glm::angleAxis(angles.z, vec3(0, 0, 1)) * glm::angleAxis(angles.y, vec3(0, 1, 0)) * glm::angleAxis(angles.x, vec3(1, 0, 0));
}

vec3 anglesOf(quat turn) {
  const mat3 m = glm::mat3_cast(turn);
  return {std::atan2(m[1][2], m[2][2]), std::asin(std::clamp(-m[0][2], -1.0f, 1.0f)), std::atan2(m[0][1], m[0][0])};
}

float angleOf(quat turn) {
  return 2 * std::atan2(glm::length(vec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

quat limited(quat turn, float most) {
  const float angle = angleOf(turn);
  return angle <= most ? turn : glm::slerp(quat(1, 0, 0, 0), turn, most / angle);
}

quat rotationOf(const mat4& world) {
  return glm::quat_cast(mat3(glm::normalize(vec3(world[0])), glm::normalize(vec3(world[1])), glm::normalize(vec3(world[2]))));
}

}  // namespace

Pose turned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns) {
  if (turns.empty()) return pose;
  Pose result = pose;
  std::vector<mat4> own(skeleton.joints.size(), mat4(1));
  for (const JointTurn& turn : turns)
    if (turn.joint.value < own.size()) own[turn.joint.value] = glm::mat4_cast(turnOf(turn.angles));
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    const mat4 before = parent.valid() ? result.world[parent.value] * glm::inverse(pose.world[parent.value]) : mat4(1);
    result.world[j] = before * pose.world[j] * own[j];
  }
  return result;
}

float mostTurn(std::string_view role) {
  for (const Limit& limit : kLimits)
    if (role.find(limit.part) != std::string_view::npos) return limit.most;
  return degrees(90);
}

vec3 withinLimit(vec3 angles, float most) {
  const quat turn = turnOf(angles);
  return angleOf(turn) <= most ? angles : anglesOf(limited(turn, most));
}

vec3 turnedFurther(vec3 angles, const mat4& world, vec3 axis, float angle, float most) {
  const quat rotation = rotationOf(world);
  const quat further = glm::inverse(rotation) * glm::angleAxis(angle, axis) * rotation;
  return anglesOf(limited(glm::normalize(turnOf(angles) * further), most));
}

}  // namespace vasa::viewer
