#include "body/arcs.h"

#include <algorithm>
#include <cmath>

#include "body/clip.h"
#include "core/cancellation.h"

namespace vasa {
namespace {

constexpr float kDegree = kPi / 180;
constexpr float kAngleWithoutClips = 100 * kDegree;
constexpr float kStill = 5 * kDegree;  // a joint that bends less in all clips
constexpr float kSmallestAngle = 40 * kDegree;
constexpr float kLargestAngle = 150 * kDegree;
constexpr float kLongestArc = 0.45f;  // of the way to a neighbouring joint
// Vessels' distance by the way to a neighbouring joint: up to this the neighbour has all of its say.
constexpr float kHasItsSay = 0.75f;
constexpr float kAngleMargin = 1.1f;
constexpr float kSteepestSlope = 1.5f * 1.1f;  // of smoothstep, and of how the way from a joint is measured
constexpr float kOverallReach = 0.5f;          // of a vessel's distance from the link in any direction
constexpr float kReachQuantile = 0.95f;
constexpr float kBesideLink = 0.1f;      // of the link's length: another bone this near runs beside it
constexpr float kNeighbourhood = 0.25f;  // of the shorter link: so far along the limb vessels are looked for
constexpr float kShortestArcLinks = 0.4f;      // of the shorter link
constexpr float kShortestArcHeights = 0.012f;  // of the body's height
constexpr std::size_t kFrameStep = 2;
constexpr std::size_t kPointsLookedAt = 4000;

/// Arc length for vessels at distance 1: they must not fold within the arc, nor the straight parts beyond its
/// ends run into one another.
float arcPerReach(float angle) {
  return std::max(kSteepestSlope * kAngleMargin * angle, 2 * std::tan(0.5f * angle));
}

/// A joint's largest bend; the axis is in rest directions, zero where any direction is possible.
struct LargestBend {
  float angle = 0;
  vec3 axis{0};
  bool moves = true;
};

std::vector<LargestBend> largestBends(const SpineSet& spines, const Body& body) {
  std::vector<LargestBend> bends(spines.joints.size());
  for (const Clip& clip : body.clips)
    for (std::uint32_t f = 0; f < clip.frameCount(); f += kFrameStep) {
      const Pose pose = samplePose(body.skeleton, clip, clip.timeOfFrame(f));
      for (std::uint32_t j = 0; j < bends.size(); ++j) {
        const vec3 bend = bendOf(spines, pose, {j});
        const float angle = glm::length(bend);
        if (angle > bends[j].angle) bends[j] = {angle, bend / angle};
      }
    }
  for (LargestBend& bend : bends) {
    bend.moves = body.clips.empty() || bend.angle > kStill;
    if (body.clips.empty()) bend.angle = kAngleWithoutClips;
    bend.angle = std::clamp(bend.angle, kSmallestAngle, kLargestAngle);
  }
  return bends;
}

/// The joint whose bones come before this joint's: joints without bones are passed over.
JointId boneBefore(const SpineSet& spines, std::span<const float> own, JointId joint) {
  JointId at = spines.joints[joint.value].parent;
  while (at.valid() && own[at.value] >= BoneField::kFar) at = spines.joints[at.value].parent;
  return at;
}

/// The shorter of the links that meet at a joint.
float shorterLink(const SpineSet& spines, std::size_t j) {
  const SpineJoint& joint = spines.joints[j];
  const float before = spines.joints[joint.parent.value].link;
  const float after = joint.link > 0 ? joint.link : before;
  return before > 0 ? std::min(before, after) : after;
}

/// How far the points around each joint lie from its link, in the plane of its largest bend.
std::vector<float> vesselReaches(const SpineSet& spines, const BoneField& bones, std::span<const vec4> points,
                                 std::span<const LargestBend> bends) {
  const std::size_t count = spines.joints.size();
  std::vector<std::vector<float>> found(count);
  std::vector<float> own(count);
  const std::size_t step = std::max<std::size_t>(1, points.size() / kPointsLookedAt);
  for (std::size_t i = 0; i < points.size(); i += step) {
    checkpoint();
    const vec3 p(points[i]);
    bones.distances(p, own);
    const auto nearest = std::uint32_t(std::min_element(own.begin(), own.end()) - own.begin());
    for (std::uint32_t j = 0; j < count; ++j) {
      const SpineJoint& joint = spines.joints[j];
      if (!joint.parent.valid() || (nearest != j && boneBefore(spines, own, {j}) != JointId{nearest}))
        continue;
      const vec3 arm = p - joint.centre;
      const vec3 axis = joint.axis != vec3(0) ? joint.axis : spines.joints[joint.parent.value].axis;
      if (std::abs(glm::dot(arm, axis)) > kNeighbourhood * shorterLink(spines, j)) continue;
      const vec3 across = arm - glm::dot(arm, axis) * axis;
      const vec3 inward = glm::cross(bends[j].axis, axis);
      const float length = glm::length(inward), overall = kOverallReach * glm::length(across);
      found[j].push_back(length > 0 ? std::max(std::abs(glm::dot(across, inward)) / length, overall)
                                    : 2 * overall);
    }
  }
  std::vector<float> reach(count, 0.0f);
  for (std::size_t j = 0; j < count; ++j) {
    if (found[j].empty()) continue;
    auto at = found[j].begin() + std::ptrdiff_t(kReachQuantile * float(found[j].size() - 1));
    std::nth_element(found[j].begin(), at, found[j].end());
    reach[j] = *at;
  }
  return reach;
}

/// Shortens arcs that would reach beyond the next joint of their limb, unless that is closer than the vessels
/// are. A joint that is about as far away as they are loses its say step by step: a vessel more or less must
/// not turn the bends of a whole trunk into others.
void shortenArcs(SpineSet& spines, std::span<const float> reach, std::span<const LargestBend> bends) {
  std::vector<float> longest(spines.joints.size(), BoneField::kFar);
  for (std::size_t j = 0; j < spines.joints.size(); ++j) {
    if (!bends[j].moves) continue;
    for (JointId at = spines.joints[j].parent; at.valid(); at = spines.joints[at.value].parent) {
      const float apart = glm::distance(spines.joints[j].centre, spines.joints[at.value].centre);
      const std::size_t above = at.value;
      const float reached = std::max(reach[j], reach[above]);
      if (apart <= reached || !bends[above].moves) continue;
      const float say = 1 - glm::smoothstep(kHasItsSay, 1.0f, reached / apart),
                  limit = kLongestArc * apart / say;
      longest[j] = std::min(longest[j], limit);
      if (spines.joints[above].next == JointId{std::uint32_t(j)})
        longest[above] = std::min(longest[above], limit);
      if (say == 1) break;
    }
  }
  for (std::size_t j = 0; j < spines.joints.size(); ++j)
    spines.joints[j].arc = std::min(spines.joints[j].arc, longest[j]);
}

bool boneRunsBeside(const SpineSet& spines, const BoneField& bones, std::size_t j) {
  constexpr int kLinkSamples = 9;
  const SpineJoint& joint = spines.joints[j];
  std::vector<float> own(spines.joints.size()), behind(own.size()), before(own.size());
  int beside = 0;
  for (int i = 0; i < kLinkSamples; ++i) {
    bones.distances(joint.centre + joint.axis * (joint.link * (float(i) + 0.5f) / kLinkSamples), own);
    distancesAcrossJoints(spines, own, behind, before);
    beside += before[j] < kBesideLink * joint.link;
  }
  return beside > kLinkSamples * 2 / 3;
}

}  // namespace

void distancesAcrossJoints(const SpineSet& spines, std::span<const float> own, std::span<float> behind,
                           std::span<float> before) {
  const std::size_t count = spines.joints.size();
  std::copy(own.begin(), own.end(), behind.begin());
  for (std::size_t j = count; j-- > 0;)
    if (const JointId parent = spines.joints[j].parent; parent.valid())
      behind[parent.value] = std::min(behind[parent.value], behind[j]);
  for (std::size_t j = 0; j < count; ++j) {
    const JointId parent = spines.joints[j].parent;
    before[j] = parent.valid() ? std::min(own[parent.value], before[parent.value]) : BoneField::kFar;
  }
}

void chooseArcs(SpineSet& spines, const Body& body, const BoneField& bones, std::span<const vec4> points) {
  if (bones.fromMeshes())
    for (std::size_t j = 0; j < spines.joints.size(); ++j)
      spines.joints[j].spreadsTwist = spines.joints[j].spreadsTwist && boneRunsBeside(spines, bones, j);
  const std::vector<LargestBend> bends = largestBends(spines, body);
  const std::vector<float> reach = vesselReaches(spines, bones, points, bends);
  const float shortest = kShortestArcHeights * body.height();
  for (std::size_t j = 0; j < spines.joints.size(); ++j) {
    SpineJoint& joint = spines.joints[j];
    joint.arc = std::max(arcPerReach(bends[j].angle) * reach[j], shortest);
    if (joint.parent.valid() && !(joint.spreadsTwist && bones.fromMeshes()))
      joint.arc = std::max(joint.arc, kShortestArcLinks * shorterLink(spines, j));
  }
  shortenArcs(spines, reach, bends);
}

}  // namespace vasa
