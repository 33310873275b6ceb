#include "body/spine.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "math/direction.h"

// Relative to rest, a joint's bone moves by M = world · restWorld⁻¹, its parent's by M₀. The joint adds
// D = Q₀⁻¹ Q, taken apart as bend · twist about the link (both in rest axes), and each part is raised to the
// share that has set in. Derivative of X(station(p)) p for a share φ(s): Q + s'(φ)·ω × (p − centre) ⊗ ∇s,
// whose determinant is 1 + ∇s·(ω × (p − centre)): at a distance R on the inner side 1 − φ'(s)·angle·R, and
// smoothstep's steepest slope is 1.5 / L.
namespace vasa {
namespace {

constexpr float kShortLink = 0.3f;         // of the link that follows: such a joint's axis is the latter's
constexpr float kReachPreference = 0.25f;  // weight of a subtree's reach against the cosine of the deviation

bool finite(const mat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

float scaleOf(const mat4& m) { return std::cbrt(std::abs(glm::determinant(mat3(m)))); }

struct AngleAxis {
  vec3 axis{1, 0, 0};
  float half = 0;
};

AngleAxis angleAxis(quat q) {
  if (q.w < 0) q = -q;
  const vec3 v(q.x, q.y, q.z);
  const float sine = glm::length(v);
  if (sine < 1e-9f) return {};
  return {v / sine, std::atan2(sine, q.w)};
}

/// The turn by 2 · half about an axis, |half| <= π / 2, from power series that are good to 6e-8 there.
quat turnAbout(vec3 axis, float half) {
  const float x = half * half;
  const float sine = half * (1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72 * (1 - x / 110)))));
  const float cosine = 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90 * (1 - x / 132)))));
  return {cosine, axis * sine};
}

/// D = bend · twist, twist about `axis`.
std::pair<AngleAxis, AngleAxis> bendAndTwist(quat d, const SpineJoint& joint) {
  if (!joint.spreadsTwist) return {angleAxis(d), AngleAxis{}};
  if (d.w < 0) d = -d;
  const float along = glm::dot(vec3(d.x, d.y, d.z), joint.axis);
  const float norm = std::hypot(d.w, along);
  if (norm < 1e-6f) return {angleAxis(d), AngleAxis{}};  // half a turn across the link: no twist is defined
  const quat twist(d.w / norm, joint.axis * (along / norm));
  return {angleAxis(d * glm::conjugate(twist)), AngleAxis{joint.axis, std::atan2(along, d.w)}};
}

/// Length of the longest way from each joint down to a tip.
std::vector<float> reaches(const SpineSet& spines) {
  std::vector<float> reach(spines.joints.size(), 0.0f);
  for (std::size_t i = spines.joints.size(); i-- > 0;) {
    const SpineJoint& joint = spines.joints[i];
    if (!joint.parent.valid()) continue;
    const float link = glm::distance(joint.centre, spines.joints[joint.parent.value].centre);
    float& above = reach[joint.parent.value];
    above = std::max(above, reach[i] + link);
  }
  return reach;
}

void chooseContinuations(SpineSet& spines) {
  const std::vector<float> reach = reaches(spines);
  std::vector<vec3> incoming(spines.joints.size(), vec3(0));
  std::vector<float> best(spines.joints.size(), -10.0f);
  for (std::size_t i = 0; i < spines.joints.size(); ++i) {
    const SpineJoint& joint = spines.joints[i];
    if (!joint.parent.valid()) continue;
    SpineJoint& parent = spines.joints[joint.parent.value];
    const vec3 way = directionOf(joint.centre - parent.centre);
    incoming[i] = way == vec3(0) ? incoming[joint.parent.value] : way;
    const float score = glm::dot(way, incoming[joint.parent.value]) +
                        kReachPreference * reach[i] / std::max(reach[joint.parent.value], 1e-9f);
    if (score > best[joint.parent.value]) {
      best[joint.parent.value] = score;
      parent.next = {std::uint32_t(i)};
    }
  }
}

/// The link's axis, leading past joints that sit close behind this one.
void measureLinks(SpineSet& spines) {
  for (SpineJoint& joint : spines.joints) {
    JointId end = joint.next;
    while (end.valid()) {
      const SpineJoint& at = spines.joints[end.value];
      const float length = glm::distance(at.centre, joint.centre);
      const float following =
          at.next.valid() ? glm::distance(spines.joints[at.next.value].centre, at.centre) : 0;
      if (length > 0 && length >= kShortLink * following) break;
      end = at.next;
    }
    if (!end.valid()) continue;
    const vec3 way = spines.joints[end.value].centre - joint.centre;
    joint.link = glm::length(way);
    joint.axis = directionOf(way);
    joint.spreadsTwist = end == joint.next;
  }
}

void collectLimbs(SpineSet& spines) {
  for (std::uint32_t i = 0; i < spines.joints.size(); ++i) {
    const JointId parent = spines.joints[i].parent;
    if (parent.valid() && spines.joints[parent.value].next == JointId{i}) continue;
    std::vector<JointId>& limb = spines.limbs.emplace_back();
    if (parent.valid()) limb.push_back(parent);
    for (JointId at{i}; at.valid(); at = spines.joints[at.value].next) limb.push_back(at);
  }
}

}  // namespace

Result<SpineSet> deriveSpines(const Skeleton& skeleton, std::string_view name) {
  if (skeleton.joints.empty())
    return badInput(
        fmt::format("{}: the body has no joints, so vessels cannot be bound to it; use a glTF file with "
                    "a skin and its skeleton",
                    name));
  SpineSet spines;
  for (const Skeleton::Joint& joint : skeleton.joints) {
    if (!finite(joint.restWorld) || !(std::abs(glm::determinant(mat3(joint.restWorld))) > 0))
      return badInput(
          fmt::format("{}: joint '{}' has a rest transform that is not finite or scales to nothing; "
                      "repair the rig and export it again",
                      name, joint.name));
    SpineJoint& added = spines.joints.emplace_back();
    added.parent = joint.parent;
    added.centre = vec3(joint.restWorld[3]);
    added.restInverse = glm::inverse(joint.restWorld);
  }
  chooseContinuations(spines);
  measureLinks(spines);
  collectLimbs(spines);
  return spines;
}

SpinePose::SpinePose(const SpineSet& spines) : motions_(spines.joints.size()) {}

void SpinePose::run(const SpineSet& spines, const Pose& pose) {
  assert(pose.world.size() == spines.joints.size() && motions_.size() == spines.joints.size());
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const SpineJoint& joint = spines.joints[i];
    const mat4 own = pose.world[i] * joint.restInverse;
    Motion& motion = motions_[i];
    motion.centre = joint.centre;
    motion.after = rotationOf(own);
    motion.scaleAfter = scaleOf(own);
    motion.centreAfter = vec3(pose.world[i][3]);
    if (joint.parent.valid()) {
      const Motion& above = motions_[joint.parent.value];
      motion.before = above.after;
      motion.scaleBefore = above.scaleAfter;
      motion.centreBefore =
          above.centreAfter + above.scaleAfter * (above.after * (joint.centre - above.centre));
    } else {
      motion.before = motion.after;
      motion.scaleBefore = motion.scaleAfter;
      motion.centreBefore = motion.centreAfter;
    }
    const auto [bend, twist] = bendAndTwist(glm::conjugate(motion.before) * motion.after, joint);
    motion.bendAxis = bend.axis;
    motion.halfBend = bend.half;
    motion.twistAxis = twist.axis;
    motion.halfTwist = twist.half;
  }
}

quat SpinePose::rotation(Station station) const {
  const Motion& m = motions_[station.joint.value];
  if (station.along >= 2) return m.after;
  if (station.along <= 0) return m.before;
  const quat bent = m.before * turnAbout(m.bendAxis, std::min(station.along, 1.0f) * m.halfBend);
  return station.along <= 1 ? bent : bent * turnAbout(m.twistAxis, (station.along - 1) * m.halfTwist);
}

quat SpinePose::turning(Station station) const {
  const Motion& m = motions_[station.joint.value];
  return station.along <= 1 ? turnAbout(m.bendAxis, station.along * m.halfBend)
                            : turnAbout(m.twistAxis, (station.along - 1) * m.halfTwist);
}

vec3 SpinePose::turn(Station station, vec3 p) const {
  const Motion& m = motions_[station.joint.value];
  return m.centre + turning(station) * (p - m.centre);
}

vec3 SpinePose::place(Station station, vec3 p) const {
  const Motion& m = motions_[station.joint.value];
  const float share = std::clamp(station.along, 0.0f, 1.0f);
  const vec3 centre = m.centreBefore + share * (m.centreAfter - m.centreBefore);
  const float scale = m.scaleBefore + share * (m.scaleAfter - m.scaleBefore);
  return centre + scale * (rotation(station) * (p - m.centre));
}

vec3 SpinePose::placeAfter(JointId joint, vec3 p) const {
  const Motion& m = motions_[joint.value];
  return m.centreAfter + m.scaleAfter * (m.after * (p - m.centre));
}

vec3 bendOf(const SpineSet& spines, const Pose& pose, JointId id) {
  const SpineJoint& joint = spines.joints[id.value];
  if (!joint.parent.valid()) return vec3(0);
  const quat own = rotationOf(pose.world[id.value] * joint.restInverse);
  const SpineJoint& parent = spines.joints[joint.parent.value];
  const quat before = rotationOf(pose.world[joint.parent.value] * parent.restInverse);
  const quat turn = glm::conjugate(before) * own;
  if (joint.axis == vec3(0)) {
    const AngleAxis whole = angleAxis(turn);
    return 2 * whole.half * whole.axis;
  }
  const vec3 bent = turn * joint.axis, axis = glm::cross(joint.axis, bent);
  return std::atan2(glm::length(axis), glm::dot(joint.axis, bent)) * directionOf(axis);
}

}  // namespace vasa
