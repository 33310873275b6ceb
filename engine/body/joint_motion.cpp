#include "body/joint_motion.h"

#include <cmath>

#include "math/direction.h"

namespace vasa {
namespace {

struct Range {
  std::string_view part;  // of the role
  vec3 least, most;       // [degrees]
};
constexpr Range kRanges[] = {
    {"UpperLeg", {-20, -30, -45}, {125, 45, 45}}, {"LowerLeg", {-145, -5, -20}, {5, 5, 20}},
    {"Foot", {-50, -25, -20}, {20, 25, 20}},      {"Toes", {-40, -10, -5}, {65, 10, 5}},
    {"UpperArm", {-60, -45, -90}, {170, 85, 90}}, {"LowerArm", {-5, -5, -90}, {150, 5, 90}},
    {"Hand", {-85, -30, -10}, {85, 30, 10}},      {"Shoulder", {-20, -10, -10}, {20, 40, 10}},
    {"Thumb", {-70, -40, -15}, {70, 40, 15}},     {"Index", {-100, -20, -10}, {100, 20, 10}},
    {"Middle", {-100, -20, -10}, {100, 20, 10}},  {"Ring", {-100, -20, -10}, {100, 20, 10}},
    {"Little", {-100, -20, -10}, {100, 20, 10}},  {"head", {-50, -40, -50}, {45, 40, 50}},
    {"neck", {-30, -30, -40}, {40, 30, 40}},      {"hest", {-20, -25, -30}, {35, 25, 30}},
    {"spine", {-20, -25, -30}, {40, 25, 30}},     {"hips", {-180, -85, -180}, {180, 85, 180}},
};

vec3 alongBone(const Skeleton& skeleton, JointId joint) {
  const auto placeOf = [&](std::uint32_t j) { return vec3(skeleton.joints[j].restWorld[3]); };
  vec3 sum(0);
  for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j)
    if (skeleton.joints[j].parent == joint) sum += placeOf(j) - placeOf(joint.value);
  const JointId parent = skeleton.joints[joint.value].parent;
  if (glm::length(sum) < 1e-6f && parent.valid()) sum = placeOf(joint.value) - placeOf(parent.value);
  return glm::length(sum) < 1e-6f ? vec3(0, 1, 0) : glm::normalize(sum);
}

// Columns: the axes of bend, spread and twist at rest, in the world.
mat3 axesAtRest(vec3 bone) {
  const vec3 towards = std::abs(bone.z) < 0.7f ? vec3(0, 0, 1) : vec3(0, 1, 0);
  const vec3 bend = glm::normalize(glm::cross(bone, towards));
  return {bend, glm::cross(bone, bend), bone};
}

// What is done to a joint: a turn in its own space, then a way in model space.
struct Own {
  mat4 turn{1}, way{1};
};

std::vector<Own> ownOf(const Skeleton& skeleton, std::span<const JointTurn> turns) {
  std::vector<Own> own(skeleton.joints.size());
  for (const JointTurn& turn : turns)
    if (turn.joint.value < own.size())
      own[turn.joint.value] = {
          glm::mat4_cast(turn.axes * turnByAngles(turn.angles) * glm::inverse(turn.axes)),
          glm::translate(mat4(1), turn.moved)};
  return own;
}

quat turnSinceRest(const Skeleton::Joint& joint, const JointMotion& motion, const mat4& before,
                   const mat4& world) {
  const quat turn = glm::inverse(joint.rest.rotation) * glm::inverse(rotationOf(before)) * rotationOf(world);
  return glm::normalize(glm::inverse(motion.axes) * turn * motion.axes);
}

// How a pose moved what hangs on a joint's parent.
mat4 alongWithParent(const Skeleton& skeleton, std::size_t joint, const Pose& before, const Pose& after) {
  const JointId parent = skeleton.joints[joint].parent;
  return parent.valid() ? after.world[parent.value] * glm::inverse(before.world[parent.value]) : mat4(1);
}

}  // namespace

quat turnByAngles(vec3 angles) {
  const vec3 across(angles.x, angles.y, 0);
  const float size = glm::length(across);
  const quat swing = size > 0 ? glm::angleAxis(size, across / size) : quat(1, 0, 0, 0);
  return swing * glm::angleAxis(angles.z, vec3(0, 0, 1));
}

vec3 anglesOfTurn(quat turn) {
  if (turn.w < 0) turn = -turn;
  const float half = std::atan2(turn.z, turn.w);
  quat swing = turn * glm::angleAxis(-2 * half, vec3(0, 0, 1));
  if (swing.w < 0) swing = -swing;
  const float sine = glm::length(vec2(swing.x, swing.y));
  const float share = sine > 0 ? 2 * std::atan2(sine, swing.w) / sine : 2;
  return {share * swing.x, share * swing.y, 2 * half};
}

vec3 anglesSinceRest(const Skeleton::Joint& joint, const JointMotion& motion, const mat4& before,
                     const mat4& world) {
  return anglesOfTurn(turnSinceRest(joint, motion, before, world));
}

vec3 anglesBeside(const Skeleton::Joint& joint, const JointMotion& motion, const mat4& before,
                  const mat4& world, vec3 sinceRest) {
  const quat there = turnSinceRest(joint, motion, before, world);
  return anglesOfTurn(glm::normalize(glm::inverse(there) * turnByAngles(sinceRest)));
}

Pose turned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns) {
  if (turns.empty()) return pose;
  const std::vector<Own> own = ownOf(skeleton, turns);
  Pose result = pose;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    result.world[j] = own[j].way * alongWithParent(skeleton, j, pose, result) * pose.world[j] * own[j].turn;
  return result;
}

Pose unturned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns) {
  if (turns.empty()) return pose;
  const std::vector<Own> own = ownOf(skeleton, turns);
  Pose result = pose;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    result.world[j] = alongWithParent(skeleton, j, pose, result) * glm::inverse(own[j].way) * pose.world[j] *
                      glm::inverse(own[j].turn);
  return result;
}

JointMotion jointMotion(const Skeleton& skeleton, JointId joint, std::string_view role) {
  JointMotion motion;
  const quat rest = rotationOf(skeleton.joints[joint.value].restWorld);
  motion.axes = glm::normalize(glm::inverse(rest) * glm::quat_cast(axesAtRest(alongBone(skeleton, joint))));
  for (const Range& range : kRanges) {
    if (role.find(range.part) == std::string_view::npos) continue;
    motion.least = glm::radians(range.least);
    motion.most = glm::radians(range.most);
    if (role.starts_with("left")) {  // spreads to the other side
      motion.least.y = -glm::radians(range.most.y);
      motion.most.y = -glm::radians(range.least.y);
    }
    break;
  }
  return motion;
}

vec3 turnedFurther(vec3 angles, const JointMotion& motion, const mat4& world, vec3 axis, float angle) {
  const quat rotation = rotationOf(world), back = glm::inverse(motion.axes);
  const quat further = glm::inverse(rotation) * glm::angleAxis(angle, axis) * rotation;
  return motion.within(anglesOfTurn(glm::normalize(turnByAngles(angles) * (back * further * motion.axes))));
}

}  // namespace vasa
