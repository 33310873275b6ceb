#include "viewer/mannequin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/humanoid.h"
#include "body/mirror.h"
#include "body/retarget.h"
#include "math/direction.h"
#include "viewer/joint_names.h"

namespace vasa::viewer {
namespace {

constexpr float kCollarStiffness = 30;  // an arm's own joints turn first
constexpr float kAbove = 0.1f;          // [m] the middle of the skull above its joint

// What is pulled, and what gives way, from the trunk outwards. @ is a side.
struct Pull {
  std::string_view tip;
  std::vector<std::string_view> moved;
};
const std::vector<Pull>& pulls() {
  static const std::vector<Pull> all{
      {"hips", {"hips"}},
      {"neck", {"spine", "chest", "upperChest"}},
      {"head", {"neck", "head"}},
      {"@UpperArm", {"@Shoulder"}},
      {"@LowerArm", {"@Shoulder", "@UpperArm"}},
      {"@Hand", {"@Shoulder", "@UpperArm", "@LowerArm"}},
      {"@UpperLeg", {"hips"}},
      {"@LowerLeg", {"@UpperLeg"}},
      {"@Foot", {"@UpperLeg", "@LowerLeg"}},
      {"@Toes", {"@Foot"}},
  };
  return all;
}

std::string onSide(std::string_view name, std::string_view side) {
  return name.starts_with("@") ? std::string(side) + std::string(name.substr(1)) : std::string(name);
}

vec3 placeOf(const Skeleton& skeleton, JointId joint) {
  return vec3(skeleton.joints[joint.value].restWorld[3]);
}

std::vector<JointId> childrenOf(const Skeleton& skeleton, JointId joint) {
  std::vector<JointId> children;
  for (std::uint32_t j = joint.value + 1; j < skeleton.joints.size(); ++j)
    if (skeleton.joints[j].parent == joint) children.push_back({j});
  return children;
}

int axisOf(JointRange::Motion motion) {
  return motion == JointRange::Motion::flexion ? 0 : motion == JointRange::Motion::abduction ? 1 : 2;
}

// Tables count from hanging arms; many bodies rest with theirs spread. [rad] beyond what an arm hangs away
// from the trunk.
float raisedAtRest(const Skeleton::Joint& joint, const JointMotion& motion, std::string_view part) {
  constexpr float kHanging = 0.26f;  // 15 degrees; the built-in human's hang by 13
  if (!part.ends_with("UpperArm")) return 0;
  const vec3 bone = rotationOf(joint.restWorld) * motion.axes * vec3(0, 0, 1);
  return std::max(0.0f, std::atan2(std::abs(bone.x), -bone.y) - kHanging);
}

bool isHinge(std::string_view part) { return part.ends_with("LowerArm") || part.ends_with("LowerLeg"); }

}  // namespace

Mannequin::Mannequin(const Skeleton& skeleton, std::span<const JointRange> ranges)
    : parts_(partsOf(skeleton).of), rolls_(skeleton.joints.size()) {
  nameJoints(skeleton);
  for (const std::string_view side : {"left", "right"})
    if (const JointId hand = find(onSide("@Hand", side)); hand.valid()) nameFingers(skeleton, hand, side);
  limitJoints(skeleton, ranges);
  findTwins(skeleton);
  findGrips(skeleton);
  for (std::uint32_t j = 0; j < parts_.size(); ++j) listed_.push_back(j);
  std::stable_partition(listed_.begin(), listed_.end(), [&](std::uint32_t j) { return !parts_[j].empty(); });
}

JointId Mannequin::find(std::string_view part) const {
  const auto found = std::ranges::find(parts_, part);
  return found == parts_.end() ? JointId{} : JointId{std::uint32_t(found - parts_.begin())};
}

void Mannequin::nameJoints(const Skeleton& skeleton) {
  for (std::uint32_t j = 0; j < parts_.size(); ++j) {
    motions_.push_back(jointMotion(skeleton, {j}, parts_[j]));
    const std::string name = peoplesName(parts_[j]);
    names_.push_back(name.empty() ? skeleton.joints[j].name : name);
  }
  // The joint between elbow and wrist, where there is one, takes the forearm's rotation.
  for (const std::string_view side : {"left", "right"}) {
    const JointId hand = find(onSide("@Hand", side)), elbow = find(onSide("@LowerArm", side));
    if (!hand.valid() || !elbow.valid()) continue;
    const JointId between = skeleton.joints[hand.value].parent;
    if (!between.valid() || between == elbow || skeleton.joints[between.value].parent != elbow) continue;
    parts_[between.value] = parts_[elbow.value];
    rolls_[between.value] = 1;
    names_[between.value] = std::string(side) + " forearm";
    JointMotion& takes = motions_[between.value];
    takes.least = {0, 0, motions_[elbow.value].least.z};
    takes.most = {0, 0, motions_[elbow.value].most.z};
    motions_[elbow.value].least.z = motions_[elbow.value].most.z = 0;
  }
}

// Fingers are told by where they leave the hand: the thumb by its name, the others by how far from it.
void Mannequin::nameFingers(const Skeleton& skeleton, JointId hand, std::string_view side) {
  constexpr std::string_view kNames[] = {"index finger", "middle finger", "ring finger", "little finger"};
  constexpr std::string_view kLinks[] = {"knuckle", "middle joint", "end joint"},
                             kThumbLinks[] = {"base joint", "knuckle", "end joint"};
  std::vector<JointId> thumb;
  std::vector<std::vector<JointId>> fingers;
  for (std::uint32_t j = hand.value + 1; j < skeleton.joints.size(); ++j) {
    if (!childrenOf(skeleton, {j}).empty()) continue;
    std::vector<JointId> chain{{j}};
    JointId above = skeleton.joints[j].parent;
    for (; above.valid() && above != hand && childrenOf(skeleton, above).size() == 1;
         above = skeleton.joints[above.value].parent)
      chain.insert(chain.begin(), above);
    JointId at = above;
    while (at.valid() && at != hand) at = skeleton.joints[at.value].parent;
    if (at != hand || chain.size() < 2 || chain.size() > std::size(kLinks)) continue;
    const bool isThumb =
        parts_[chain.front().value].ends_with("ThumbProximal") ||
        plainName(skeleton.joints[chain.front().value].name).find("thumb") != std::string::npos;
    if (isThumb)
      thumb = std::move(chain);
    else
      fingers.push_back(std::move(chain));
  }
  const auto name = [&](const std::vector<JointId>& chain, std::string_view finger,
                        std::span<const std::string_view> links) {
    for (std::size_t k = 0; k < chain.size(); ++k)
      names_[chain[k].value] = fmt::format("{} {}, {}", side, finger, links[k]);
  };
  if (thumb.empty() || fingers.size() != std::size(kNames)) return;
  const vec3 root = placeOf(skeleton, thumb.front());
  std::ranges::sort(fingers, {}, [&](const std::vector<JointId>& finger) {
    return glm::distance(root, placeOf(skeleton, finger.front()));
  });
  name(thumb, "thumb", kThumbLinks);
  for (std::size_t f = 0; f < fingers.size(); ++f) name(fingers[f], kNames[f], kLinks);
}

void Mannequin::limitJoints(const Skeleton& skeleton, std::span<const JointRange> ranges) {
  for (const JointRange& range : ranges) {
    const int axis = axisOf(range.motion);
    const float sense = sensesOf(range.part)[axis];
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      if (parts_[j] != range.part || motions_[j].least[axis] == motions_[j].most[axis]) continue;
      const float raised = axis == 1 ? raisedAtRest(skeleton.joints[j], motions_[j], range.part) : 0;
      const float low = sense * (range.low - raised), high = sense * (range.high - raised);
      motions_[j].least[axis] = std::min(low, high);
      motions_[j].most[axis] = std::max(low, high);
    }
  }
}

void Mannequin::findTwins(const Skeleton& skeleton) {
  constexpr float kSamePlace = 0.01f;  // [m]
  for (std::uint32_t j = 0; j < parts_.size(); ++j) {
    JointId twin{j};
    if (!parts_[j].empty() && !rolls_[j]) {
      if (const JointId other = find(mirrored(parts_[j])); other.valid()) twin = other;
    } else {
      float nearest = kSamePlace;
      for (std::uint32_t k = 0; k < parts_.size(); ++k) {
        const float off = glm::distance(placeOf(skeleton, {k}), vec3(-1, 1, 1) * placeOf(skeleton, {j}));
        if (parts_[k].empty() == parts_[j].empty() && rolls_[k] == rolls_[j] && off < nearest)
          nearest = off, twin = {k};
      }
    }
    twins_.push_back(twin);
  }
}

ReachJoint Mannequin::turning(JointId joint) const {
  const JointMotion& motion = motions_[joint.value];
  ReachJoint turns{joint, motion.axes, motion.least, motion.most};
  const std::string_view part = parts_[joint.value];
  if (isHinge(part) && !rolls_[joint.value]) turns.least.y = turns.most.y = turns.least.z = turns.most.z = 0;
  if (part.ends_with("Shoulder")) turns.stiffness = kCollarStiffness;
  return turns;
}

void Mannequin::findGrips(const Skeleton& skeleton) {
  for (const Pull& pull : pulls())
    for (const std::string_view side : {"left", "right"}) {
      if (!pull.tip.starts_with("@") && side == "right") continue;
      const JointId tip = find(onSide(pull.tip, side));
      if (!tip.valid()) continue;
      Grip grip{names_[tip.value], {{}, tip}};
      for (const std::string_view part : pull.moved)
        if (const JointId joint = find(onSide(part, side)); joint.valid())
          grip.limb.joints.push_back(turning(joint));
      if (grip.limb.joints.empty()) continue;
      if (pull.tip == "neck") {  // a back's range is the whole back's
        const ReachJoint whole = grip.limb.joints.front();
        for (ReachJoint& joint : grip.limb.joints) {
          joint.least = whole.least / float(grip.limb.joints.size());
          joint.most = whole.most / float(grip.limb.joints.size());
        }
      }
      if (tip == grip.limb.joints.back().joint)  // it turns about itself: what is pulled lies above it
        grip.limb.offset =
            glm::inverse(rotationOf(skeleton.joints[tip.value].restWorld)) * vec3(0, kAbove, 0);
      grip.carries = pull.tip == "hips";
      grips_.push_back(std::move(grip));
    }
  for (std::uint32_t j = 0; j < parts_.size(); ++j) gripHand(skeleton, {j});
  if (!grips_.empty()) return;
  // Nothing is known of this skeleton: each joint turns the one it hangs on.
  for (std::uint32_t j = 0; j < parts_.size(); ++j)
    if (const JointId parent = skeleton.joints[j].parent; parent.valid())
      grips_.push_back({names_[j], {{turning(parent)}, {j}}});
}

// Knuckles turn the wrist, what lies beyond them its finger, by its end, too.
void Mannequin::gripHand(const Skeleton& skeleton, JointId joint) {
  std::vector<JointId> above;  // up to the hand, the nearest last
  JointId hand = skeleton.joints[joint.value].parent;
  for (; hand.valid() && !parts_[hand.value].ends_with("Hand"); hand = skeleton.joints[hand.value].parent)
    above.insert(above.begin(), hand);
  if (!hand.valid()) return;
  std::vector<ReachJoint> finger;
  for (const JointId each : above)
    if (childrenOf(skeleton, each).size() == 1) finger.push_back(turning(each));
  const std::string side = parts_[hand.value].starts_with("left") ? "left" : "right";
  if (parts_[joint.value].empty()) motions_[joint.value] = jointMotion(skeleton, joint, side + "Index");
  if (names_[joint.value] == skeleton.joints[joint.value].name)
    names_[joint.value] = side + " hand, " + skeleton.joints[joint.value].name;
  const bool leaf = childrenOf(skeleton, joint).empty();
  if (finger.empty()) {
    const JointId before = skeleton.joints[hand.value].parent;
    std::vector<ReachJoint> wrist;
    if (before.valid() && rolls_[before.value]) wrist.push_back(turning(before));
    wrist.push_back(turning(hand));
    grips_.push_back({names_[joint.value], {std::move(wrist), joint}, true});
  } else {
    grips_.push_back({names_[joint.value], {finger, joint}, true});
  }
  if (!leaf) return;
  finger.push_back(turning(joint));
  const vec3 link = placeOf(skeleton, joint) - placeOf(skeleton, skeleton.joints[joint.value].parent);
  const vec3 end = glm::inverse(rotationOf(skeleton.joints[joint.value].restWorld)) * (0.8f * link);
  // "left index finger, end joint": the finger's own.
  const std::string& name = names_[joint.value];
  const bool named = name.ends_with(", end joint");
  grips_.push_back(
      {(named ? name.substr(0, name.rfind(',')) : name) + ", tip", {std::move(finger), joint, end}, true});
}

std::vector<JointTurn> mirroredTurns(const Mannequin& mannequin, std::span<const JointTurn> turns) {
  std::vector<JointTurn> all;
  for (const JointTurn& turn : turns) {
    const JointId twin = mannequin.twinOf(turn.joint);
    all.push_back(
        {twin, mirroredAngles(turn.angles), mannequin.motion(twin).axes, vec3(-1, 1, 1) * turn.moved});
  }
  return all;
}

}  // namespace vasa::viewer
