#include "viewer/pose_tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/projection.h"

namespace vasa::viewer {
namespace {

constexpr float kJointReach = 10;  // [pixels of an ordinary screen] of a handle
// [pixels of an ordinary screen] between two; those of the body may overlap a little.
constexpr float kApart = 1.5f * kHandleRadius, kFineApart = 2 * kHandleRadius;

vec3 placeOf(const Grip& grip, const Pose& pose) {
  return vec3(pose.world[grip.limb.tip.value] * vec4(grip.limb.offset, 1));
}

// The transform that a joint's own comes on top of.
const mat4& before(const Skeleton& skeleton, const Pose& pose, JointId joint) {
  const JointId parent = skeleton.joints[joint.value].parent;
  return parent.valid() ? pose.world[parent.value] : skeleton.rootTransform;
}

std::vector<vec3> anglesIn(const Skeleton& skeleton, const Mannequin& mannequin, const ReachLimb& limb,
                           const Pose& pose) {
  std::vector<vec3> angles;
  for (const ReachJoint& each : limb.joints)
    angles.push_back(anglesSinceRest(skeleton.joints[each.joint.value], mannequin.motion(each.joint),
                                     before(skeleton, pose, each.joint), pose.world[each.joint.value]));
  return angles;
}

// What a clip, or a slider, has beyond a joint's limits is no reason to jump back; what is held stays as it
// is.
ReachLimb widened(ReachLimb limb, std::span<const vec3> angles) {
  for (std::size_t k = 0; k < limb.joints.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      float &least = limb.joints[k].least[axis], &most = limb.joints[k].most[axis];
      const bool held = least == most;
      least = held ? angles[k][axis] : std::min(least, angles[k][axis]);
      most = held ? angles[k][axis] : std::max(most, angles[k][axis]);
    }
  return limb;
}

}  // namespace

std::vector<JointHandle> jointHandles(const Mannequin& mannequin, const Pose& pose, const Camera& camera,
                                      const Rect& picture, float scale) {
  struct Seen {
    JointHandle handle;
    bool fine;
    float far;
  };
  std::vector<Seen> seen;
  for (std::size_t g = 0; g < mannequin.grips().size(); ++g) {
    const Grip& grip = mannequin.grips()[g];
    const vec3 there = placeOf(grip, pose);
    const auto place = seenAt(there, camera, picture);
    if (place && picture.holds(*place))
      seen.push_back({{g, *place}, grip.fine, glm::distance(there, camera.position)});
  }
  std::ranges::stable_sort(
      seen, [](const Seen& a, const Seen& b) { return a.fine != b.fine ? b.fine : a.far < b.far; });
  std::vector<JointHandle> handles;
  for (const Seen& each : seen) {
    const auto covers = [&](const JointHandle& other) {
      return glm::distance(other.place, each.handle.place) < (each.fine ? kFineApart : kApart) * scale;
    };
    if (std::ranges::none_of(handles, covers)) handles.push_back(each.handle);
  }
  return handles;
}

std::optional<JointHandle> handleAt(std::span<const JointHandle> handles, vec2 place, float scale) {
  const auto nearest = std::ranges::min_element(
      handles, {}, [&](const JointHandle& h) { return glm::distance(h.place, place); });
  if (nearest == handles.end() || glm::distance(nearest->place, place) > kJointReach * scale)
    return std::nullopt;
  return *nearest;
}

JointTurn& turnOfJoint(ViewState& state, JointId joint, const JointMotion& motion) {
  const auto found = std::ranges::find(state.turns, joint, &JointTurn::joint);
  return found != state.turns.end() ? *found
                                    : state.turns.emplace_back(JointTurn{joint, vec3(0), motion.axes});
}

void followOnOtherSide(const Mannequin& mannequin, ViewState& state, JointId joint) {
  const JointId twin = mannequin.twinOf(joint);
  if (!state.bothSides || twin == joint) return;
  const vec3 angles = turnOfJoint(state, joint, mannequin.motion(joint)).angles;
  turnOfJoint(state, twin, mannequin.motion(twin)).angles = mirroredAngles(angles);
}

bool PoseTool::feed(const InputEvent& event, bool single, const Document& document, const PosedBody& body,
                    const Camera& camera, const Rect& picture, ViewState& state) {
  if (const auto* moved = std::get_if<PointerMoved>(&event)) {
    if (held_ && held_->single) turn(moved->place, document, body, camera, picture, state);
    if (held_ && !held_->single) pull(moved->place, document, body, camera, picture, state);
    place_ = moved->place;
    return held_.has_value();
  }
  const auto* button = std::get_if<ButtonChanged>(&event);
  if (!button || button->button != Button::left) return false;
  if (!button->down) return std::exchange(held_, std::nullopt).has_value();
  const auto handle =
      handleAt(jointHandles(*document.mannequin, body.pose, camera, picture, scale_), place_, scale_);
  if (!handle) return false;
  take(*handle, single, document, body, state);
  return true;
}

std::vector<PoseTool::Planted> PoseTool::plantedFeet(const Grip& pulled, const Document& document,
                                                     const PosedBody& body) {
  const Mannequin& mannequin = *document.mannequin;
  std::vector<Planted> feet;
  const JointId pelvis = mannequin.find("hips");
  if (std::ranges::find(pulled.limb.joints, pelvis, &ReachJoint::joint) == pulled.limb.joints.end())
    return feet;
  for (std::size_t g = 0; g < mannequin.grips().size(); ++g) {
    const Grip& grip = mannequin.grips()[g];
    if (!mannequin.partOf(grip.limb.tip).ends_with("Foot")) continue;
    const auto angles = anglesIn(document.scene.body.skeleton, mannequin, grip.limb, body.pose);
    feet.push_back({g, placeOf(grip, body.pose), body.pose.world[grip.limb.tip.value], angles, angles});
  }
  return feet;
}

// Turns the leg so that its foot is where it was, and the ankle so that it stands as it stood: under weight
// an ankle bends farther than the tables' hanging ones (20 degrees), which would put the toes through the
// floor of a squat. @return [m] how far above its place the foot is
float PoseTool::hold(Planted& foot, const Pose& clip, const Document& document, ViewState& state) {
  const Skeleton& skeleton = document.scene.body.skeleton;
  const Mannequin& mannequin = *document.mannequin;
  const auto set = [&](JointId joint, vec3 sinceRest) {
    const JointMotion& motion = mannequin.motion(joint);
    turnOfJoint(state, joint, motion).angles =
        anglesBeside(skeleton.joints[joint.value], motion, before(skeleton, clip, joint),
                     clip.world[joint.value], sinceRest);
  };
  const ReachLimb limb = widened(mannequin.grips()[foot.grip].limb, foot.pressed);
  const Reached there =
      reach(skeleton, turned(skeleton, clip, state.turns), limb, foot.at, foot.pressed, foot.latest);
  for (std::size_t k = 0; k < limb.joints.size(); ++k) set(limb.joints[k].joint, there.angles[k]);
  foot.latest = there.angles;
  const Pose now = turned(skeleton, clip, state.turns);
  const JointMotion& ankle = mannequin.motion(limb.tip);
  set(limb.tip,
      anglesSinceRest(skeleton.joints[limb.tip.value], ankle, before(skeleton, now, limb.tip), foot.stands));
  return there.end.y - foot.at.y;
}

// Moves the pelvis, but not so far down that a foot would have to sink.
void PoseTool::carry(vec3 way, const Pose& clip, const Document& document, ViewState& state) {
  constexpr float kFloor = 1e-3f;  // [m] that a foot may sink
  constexpr int kRaises = 4;       // raised by what is missing, folded legs lack less each time
  const JointId pelvis = document.mannequin->grips()[held_->grip].limb.tip;
  const JointMotion& motion = document.mannequin->motion(pelvis);
  vec3 moved = held_->moved + way;
  for (int raised = 0;; ++raised) {
    turnOfJoint(state, pelvis, motion).moved = moved;
    float sunk = 0;
    for (Planted& foot : held_->feet) sunk = std::max(sunk, -hold(foot, clip, document, state));
    if (sunk < kFloor || raised == kRaises) return;
    moved.y += sunk;
  }
}

void PoseTool::take(const JointHandle& handle, bool single, const Document& document, const PosedBody& body,
                    ViewState& state) {
  const Grip& grip = document.mannequin->grips()[handle.grip];
  held_ = Held{handle.grip,
               single,
               handle.place - place_,
               placeOf(grip, body.pose),
               anglesIn(document.scene.body.skeleton, *document.mannequin, grip.limb, body.pose),
               {},
               single ? std::vector<Planted>{} : plantedFeet(grip, document, body),
               vec3(0)};
  const auto posed = std::ranges::find(state.turns, grip.limb.tip, &JointTurn::joint);
  if (posed != state.turns.end()) held_->moved = posed->moved;
  held_->latest = held_->pressed;
  state.joint = grip.limb.joints.back().joint;  // whose sliders go along
  state.playback.playing = false;
}

void PoseTool::pull(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
                    const Rect& picture, ViewState& state) {
  const Skeleton& skeleton = document.scene.body.skeleton;
  const Mannequin& mannequin = *document.mannequin;
  const auto was = seenAt(held_->from, camera, picture);
  if (!was) return;
  const vec3 target = held_->from + wayInPlane(camera, held_->from, to + held_->off - *was, picture.height);
  const Pose clip = unturned(skeleton, body.pose, body.order.turns);
  if (mannequin.grips()[held_->grip].carries) return carry(target - held_->from, clip, document, state);
  const ReachLimb limb = widened(mannequin.grips()[held_->grip].limb, held_->pressed);
  const Reached there =
      reach(skeleton, turned(skeleton, clip, state.turns), limb, target, held_->pressed, held_->latest);
  for (std::size_t k = 0; k < limb.joints.size(); ++k) {
    if (there.angles[k] == held_->latest[k]) continue;
    const JointId joint = limb.joints[k].joint;
    const JointMotion& motion = mannequin.motion(joint);
    turnOfJoint(state, joint, motion).angles =
        anglesBeside(skeleton.joints[joint.value], motion, before(skeleton, clip, joint),
                     clip.world[joint.value], there.angles[k]);
    followOnOtherSide(mannequin, state, joint);
  }
  held_->latest = there.angles;
  for (Planted& foot : held_->feet) hold(foot, clip, document, state);
}

void PoseTool::turn(vec2 to, const Document& document, const PosedBody& body, const Camera& camera,
                    const Rect& picture, ViewState& state) const {
  const JointId joint = document.mannequin->grips()[held_->grip].limb.joints.back().joint;
  const mat4& world = body.pose.world[joint.value];
  const auto centre = seenAt(vec3(world[3]), camera, picture);
  if (!centre) return;
  const vec2 from = place_ - *centre, after = to - *centre;
  if (glm::length(from) < 2 || glm::length(after) < 2) return;
  // Rows run down: what turns right there is a negative turn about the axis towards the eye.
  const float angle = -std::atan2(from.x * after.y - from.y * after.x, glm::dot(from, after));
  const JointMotion& motion = document.mannequin->motion(joint);
  JointTurn& turn = turnOfJoint(state, joint, motion);
  turn.angles = turnedFurther(turn.angles, motion, world, cameraAxes(camera)[2], angle);
  followOnOtherSide(*document.mannequin, state, joint);
}

}  // namespace vasa::viewer
