#include "viewer/pose_tool.h"

#include <algorithm>
#include <cmath>

#include "body/humanoid.h"
#include "viewer/projection.h"

namespace vasa::viewer {
namespace {

constexpr float kReach = 9, kApart = 8;  // [pixels of an ordinary screen] of a handle, of two handles

}  // namespace

std::vector<JointHandle> jointHandles(const Skeleton& skeleton, const Pose& pose, const Camera& camera,
                                      const Rect& picture, float scale) {
  std::vector<JointHandle> handles;
  for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j) {
    if (!skeleton.joints[j].parent.valid()) continue;
    const auto place = seenAt(vec3(pose.world[j][3]), camera, picture);
    if (!place || !picture.holds(*place)) continue;
    const auto covers = [&](const JointHandle& other) {
      return glm::distance(other.place, *place) < kApart * scale;
    };
    if (std::ranges::none_of(handles, covers)) handles.push_back({{j}, *place});
  }
  return handles;
}

std::optional<JointHandle> handleAt(std::span<const JointHandle> handles, vec2 place, float scale) {
  const auto nearest = std::ranges::min_element(
      handles, {}, [&](const JointHandle& h) { return glm::distance(h.place, place); });
  if (nearest == handles.end() || glm::distance(nearest->place, place) > kReach * scale) return std::nullopt;
  return *nearest;
}

std::vector<JointMotion> jointMotions(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Skeleton::Joint& each : skeleton.joints) names.push_back(each.name);
  const HumanoidNames roles = humanoidNames(names);
  std::vector<JointMotion> motions;
  for (std::uint32_t j = 0; j < names.size(); ++j) motions.push_back(jointMotion(skeleton, {j}, roles.of[j]));
  return motions;
}

JointTurn& turnOfJoint(ViewState& state, JointId joint, const JointMotion& motion) {
  const auto found = std::ranges::find(state.turns, joint, &JointTurn::joint);
  return found != state.turns.end() ? *found
                                    : state.turns.emplace_back(JointTurn{joint, vec3(0), motion.axes});
}

bool PoseTool::feed(const InputEvent& event, const Document& document, const PosedBody& body,
                    const Camera& camera, const Rect& picture, ViewState& state) {
  const Skeleton& skeleton = document.scene.body.skeleton;
  if (const auto* moved = std::get_if<PointerMoved>(&event)) {
    if (held_) drag(moved->place, document, body, camera, picture, state);
    place_ = moved->place;
    return held_.has_value();
  }
  const auto* button = std::get_if<ButtonChanged>(&event);
  if (!button || button->button != Button::left) return false;
  if (!button->down) return std::exchange(held_, std::nullopt).has_value();
  const auto handle = handleAt(jointHandles(skeleton, body.pose, camera, picture, scale_), place_, scale_);
  if (!handle) return false;
  held_ = handle->joint;
  state.joint = skeleton.joints[held_->value].parent;  // whose sliders go along
  state.playback.playing = false;
  return true;
}

void PoseTool::drag(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
                    const Rect& picture, ViewState& state) {
  const Skeleton& skeleton = document.scene.body.skeleton;
  const JointId turning = skeleton.joints[held_->value].parent;
  const mat4& world = body.pose.world[turning.value];
  const auto centre = seenAt(vec3(world[3]), camera, picture);
  if (!centre) return;
  const vec2 before = place_ - *centre, after = to - *centre;
  if (glm::length(before) < 2 || glm::length(after) < 2) return;
  // Rows run down: what turns right there is a negative turn about the axis towards the eye.
  const float angle = -std::atan2(before.x * after.y - before.y * after.x, glm::dot(before, after));
  const JointMotion motion = jointMotions(skeleton)[turning.value];
  JointTurn& turn = turnOfJoint(state, turning, motion);
  turn.angles = turnedFurther(turn.angles, motion, world, cameraAxes(camera)[2], angle);
}

}  // namespace vasa::viewer
