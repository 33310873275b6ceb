#include "body/phases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "body/arcs.h"
#include "core/cancellation.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kSoftening = 0.2f;
constexpr float kNarrowArc = 0.6f;      // of the way between the bones before and behind a joint
constexpr float kNarrowestArc = 0.25f;  // of the arc
constexpr float kLimbFavour = 1.5f;     // a limb beside the body keeps vessels 1 + this times as far from it
constexpr float kFavourReach = 0.3f;    // of the arc: if they are no farther from it than once to twice this
constexpr float kNearness = 0.65f;  // a limb takes part if the nearest is nearer than it by no more than this
constexpr float kLimbBlur = 0.02f;  // of the limbs' length, added to the distances that are compared
constexpr float kSkinDoubt = 0.5f;  // weight of the distance to the skin against that to bones
constexpr float kSkinReach = 0.6f;  // of the arc: skin is trusted so near a joint, not at all twice as far
constexpr float kDecided = 0.15f;   // ratio of distances to bones below which they alone decide
constexpr float kUndecided = 0.4f;  // above which they do not
constexpr float kSkinTells = 0.3f;  // share of the skin from which limbs at a fork are told apart by it
constexpr float kLeastShare = 0.02f;  // of the nearest limb, whatever the skin says
constexpr float kSkinMargin = 0.08f;  // shares of the skin below this and above 1 - this are whole
// Of the link before a joint, or its arc: so far back a bone that hangs over from behind the joint begins to
// lose its say, and has lost it.
constexpr float kOverhangFrom = 0.25f, kOverhangTo = 0.75f;
// Of a link's length: how far from its axis flesh is all of that link's; at twice that none is. Half a
// thigh's or an upper arm's thickness is 0.15 of its length. With 0.12 that leaves vessels below the skin to
// the skin; with 0.16 and 0.2 those of the armpit are strained by 55 % in raised arms, and of the groin kink
// in a squat.
constexpr float kFleshOfLink = 0.12f;
constexpr float kTwistTilt = 8;  // largest ratio by which nearness to one bone tilts the spread of twist
constexpr float kSlope = 1.5f * 1.25f;  // over an arc
constexpr float kTwistSlope = 6;        // over a link
constexpr std::size_t kBlock = 64;

float smoothstep(float x) { return glm::smoothstep(0.0f, 1.0f, x); }

/// How far [m] a place is beyond the plane of a joint, from its distances to the bones before and behind:
/// where these are two straight links, before² − behind² is ± the square of that way. The softening keeps the
/// slope finite between bones that face each other.
float beyond(float before, float behind) {
  const float squares = before * before - behind * behind, soft = kSoftening * (before + behind);
  return squares / std::max(std::sqrt(std::abs(squares) + soft * soft), 1e-9f);
}

/// Length [m] of the longest way from each joint to a tip, the link that leads to the joint included.
std::vector<float> limbLengths(const SpineSet& spines) {
  std::vector<float> lengths(spines.joints.size(), 0.0f);
  for (std::size_t j = lengths.size(); j-- > 0;) {
    const JointId parent = spines.joints[j].parent;
    if (!parent.valid()) continue;
    lengths[j] += glm::distance(spines.joints[j].centre, spines.joints[parent.value].centre);
    lengths[parent.value] = std::max(lengths[parent.value], lengths[j]);
  }
  return lengths;
}

/// For each joint, what is added to distances where its limb is compared with those beside it.
std::vector<float> limbBlurs(const SpineSet& spines) {
  const std::vector<float> lengths = limbLengths(spines);
  std::vector<float> longest(lengths.size() + 1, 0.0f), blurs(lengths.size());
  const auto fork = [&](std::size_t j) {
    const JointId parent = spines.joints[j].parent;
    return parent.valid() ? parent.value : lengths.size();
  };
  for (std::size_t j = 0; j < lengths.size(); ++j) longest[fork(j)] = std::max(longest[fork(j)], lengths[j]);
  for (std::size_t j = 0; j < lengths.size(); ++j) blurs[j] = std::max(kLimbBlur * longest[fork(j)], 1e-6f);
  return blurs;
}

/// Measures one point at a time; scratch is kept between them.
class PhaseMeter {
 public:
  PhaseMeter(const SpineSet& spines, const BoneField& bones, const SkinField& skin,
             std::span<const float> blurs)
      : spines_(spines),
        bones_(bones),
        skin_(skin),
        blurs_(blurs),
        own_(spines.joints.size()),
        behind_(own_),
        before_(own_),
        skinShares_(own_),
        nearest_(own_.size() + 1),
        skinOfLimbs_(nearest_) {}

  void measure(vec3 p, std::size_t point, Phases& phases) {
    bones_.distances(p, own_);
    distancesAcrossJoints(spines_, own_, behind_, before_);
    skinDistance_ = skin_.shares(spines_, p, skinShares_);
    std::fill(nearest_.begin(), nearest_.end(), BoneField::kFar);
    for (std::size_t j = 0; j < own_.size(); ++j) nearest_[fork(j)] = std::min(nearest_[fork(j)], behind_[j]);
    std::fill(skinOfLimbs_.begin(), skinOfLimbs_.end(), 0.0f);
    for (std::size_t j = 0; j < own_.size(); ++j) skinOfLimbs_[fork(j)] += skinShares_[j];
    for (std::size_t j = 0; j < own_.size(); ++j) {
      const std::size_t at = phases.at(j, point);
      phases.bend[at] = bend(j, p);
      phases.twist[at] = twist(j, p);
      // A bone that leads nowhere, as the knee cap, takes no part in what lies before its own joint.
      phases.nearness[at] = nearness(j) * (spines_.joints[j].next.valid() ? 1 : phases.bend[at]);
    }
  }

 private:
  std::size_t fork(std::size_t j) const {
    const JointId parent = spines_.joints[j].parent;
    return parent.valid() ? parent.value : own_.size();
  }

  float bend(std::size_t j, vec3 p) const {
    if (behind_[j] >= BoneField::kFar) return 0;
    if (!spines_.joints[j].parent.valid() || before_[j] >= BoneField::kFar) return 1;
    const SpineJoint& joint = spines_.joints[j];
    const float alongside = runsAlongside(j, p);
    const float narrow =
        std::clamp(kNarrowArc * (before_[j] + behind_[j]), kNarrowestArc * joint.arc, joint.arc);
    const float onward = smoothstep(2 * glm::dot(p - joint.centre, joint.axis) / joint.arc);
    const float near = smoothstep(2 - behind_[j] / (kFavourReach * joint.arc));
    const float flesh = skinDistance_ >= BoneField::kFar ? 1.0f : smoothstep(2 * skinShares_[j]);
    const float favour = joint.spreadsTwist ? 1.0f : 1 + kLimbFavour * alongside * onward * near * flesh;
    const float measured =
        (1 - overhang(j, p)) *
        smoothstep(0.5f + beyond(favour * before_[j], behind_[j]) / glm::mix(joint.arc, narrow, alongside));
    const float told = std::clamp((skinShares_[j] - kSkinMargin) / (1 - 2 * kSkinMargin), 0.0f, 1.0f);
    const float share = glm::mix(measured, told, trustInSkin(j, p));
    const float beyondPlane = smoothstep(0.5f + glm::dot(p - joint.centre, joint.axis) / joint.arc);
    return glm::mix(share, std::max(share, beyondPlane), besideLink(j, p));
  }

  /// 1 in the flesh around the link after a joint, where the bone before the joint reaches beside it and is
  /// about as near: the seat bone does not hold back what runs along the thigh.
  float besideLink(std::size_t j, vec3 p) const {
    const SpineJoint& joint = spines_.joints[j];
    if (joint.spreadsTwist || !joint.next.valid() || !(joint.link > 0)) return 0;
    const vec3 arm = p - joint.centre;
    const float aside = glm::length(arm - glm::dot(arm, joint.axis) * joint.axis);
    return undecided(j) * smoothstep(2 * skinShares_[j]) *
           smoothstep(2 - aside / (kFleshOfLink * joint.link));
  }

  /// Not so of bones that slide under the skin, as the knee cap does.
  bool skinFollows(std::size_t j) const {
    return spines_.joints[j].next.valid() || skin_.follows({std::uint32_t(j)});
  }

  /// 0 where one of the bones before and behind the joint is much nearer, 1 where they are about equally
  /// near.
  float undecided(std::size_t j) const {
    const auto [bone, other] = std::minmax(before_[j], behind_[j]);
    return smoothstep((bone / std::max(other, 1e-6f) - kDecided) / (kUndecided - kDecided));
  }

  /// How much a bone that reaches back over the link before its joint has no say at a place beside that link:
  /// a jaw does not turn what lies deep in the neck.
  float overhang(std::size_t j, vec3 p) const {
    const SpineJoint& joint = spines_.joints[j];
    const SpineJoint& before = spines_.joints[joint.parent.value];
    const float back = glm::dot(joint.centre - p, before.axis) / std::max(before.link, joint.arc);
    return smoothstep((back - kOverhangFrom) / (kOverhangTo - kOverhangFrom)) * undecided(j);
  }

  /// What the skin tells counts where it is nearer than the bones before and behind the joint, and these are
  /// about equally near.
  float trustInSkin(std::size_t j, vec3 p) const {
    if (skinDistance_ >= BoneField::kFar || spines_.joints[j].spreadsTwist || !skinFollows(j)) return 0;
    const float bone = std::min(before_[j], behind_[j]);
    const float around = smoothstep(2 - glm::distance(p, spines_.joints[j].centre) /
                                            std::max(kSkinReach * spines_.joints[j].arc, 1e-6f));
    return around * undecided(j) * bone * bone /
           std::max(bone * bone + kSkinDoubt * skinDistance_ * skinDistance_, 1e-12f);
  }

  /// 1 where the bones before and behind are close together away from the joint, as those of an arm beside
  /// the chest; 0 around the joint itself. There the arc narrows, and what lies between goes with the limb.
  float runsAlongside(std::size_t j, vec3 p) const {
    const SpineJoint& joint = spines_.joints[j];
    const float between = before_[j] + behind_[j], away = glm::distance(p, joint.centre);
    return smoothstep(2 * away / joint.arc - 1) * smoothstep(2 - 2 * between / std::max(away, 1e-6f));
  }

  float twist(std::size_t j, vec3 p) const {
    const SpineJoint& joint = spines_.joints[j];
    if (!joint.spreadsTwist) return 1;
    const float way = smoothstep(glm::dot(p - joint.centre, joint.axis) / joint.link);
    float tilt = 1;
    if (bones_.fromMeshes())
      tilt = std::clamp(behind_[j] / std::max(before_[j], 1e-6f), 1 / kTwistTilt, kTwistTilt);
    return way / (way + tilt * (1 - way));
  }

  float nearness(std::size_t j) const {
    if (behind_[j] >= BoneField::kFar) return 0;
    const float ratio = (nearest_[fork(j)] + blurs_[j]) / (behind_[j] + blurs_[j]);
    const float near = smoothstep((ratio - kNearness) / (1 - kNearness));
    const float told = skinOfLimbs_[fork(j)];
    if (skinDistance_ >= BoneField::kFar || !(told > kSkinTells) || !skinFollows(j)) return near;
    const float bone = nearest_[fork(j)], doubt = kSkinDoubt * skinDistance_ * skinDistance_;
    const float trust = smoothstep((told - kSkinTells) / (1 - 2 * kSkinTells)) * bone * bone /
                        std::max(bone * bone + doubt, 1e-12f);
    return glm::mix(near, near * std::max(skinShares_[j] / told, kLeastShare), trust);
  }

  const SpineSet& spines_;
  const BoneField& bones_;
  const SkinField& skin_;
  std::span<const float> blurs_;
  std::vector<float> own_, behind_, before_, skinShares_, nearest_, skinOfLimbs_;
  float skinDistance_ = 0;
};

/// Each point's ties.
class TieTable {
 public:
  struct Way {
    std::uint32_t to;
    float length;  ///< [m]
  };
  TieTable(std::span<const vec4> points, std::span<const Tie> ties)
      : first_(points.size() + 1, 0), ways_(2 * ties.size()) {
    for (const Tie& tie : ties) ++first_[tie.a], ++first_[tie.b];
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0u);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Tie& tie : ties) {
      const float length = glm::distance(vec3(points[tie.a]), vec3(points[tie.b]));
      ways_[next[tie.a]++] = {tie.b, length};
      ways_[next[tie.b]++] = {tie.a, length};
    }
  }
  std::span<const Way> from(std::uint32_t point) const {
    return std::span(ways_).subspan(first_[point], first_[point + 1] - first_[point]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<Way> ways_;
};

/// Lowers values until none exceeds a neighbour's by more than the slope allows; raises them with sign = -1.
/// From the least value on (Dijkstra), so that each is lowered once and what is flat is left alone.
/// @return whether there was any
bool level(std::span<float> values, const TieTable& ties, float slope, float sign) {
  using Open = std::pair<float, std::uint32_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto exceeds = [&](const TieTable::Way& way, std::uint32_t point) {
    return sign * (values[way.to] - values[point]) > slope * way.length;
  };
  for (std::uint32_t point = 0; point < values.size(); ++point)
    if (std::ranges::any_of(ties.from(point), [&](const auto& way) { return exceeds(way, point); }))
      open.emplace(sign * values[point], point);
  const bool any = !open.empty();
  Checkpoints checkpoints;
  while (!open.empty()) {
    checkpoints.pass();
    const auto [value, point] = open.top();
    open.pop();
    if (value != sign * values[point]) continue;  // lowered since
    for (const TieTable::Way& way : ties.from(point)) {
      if (!exceeds(way, point)) continue;
      values[way.to] = values[point] + sign * (slope * way.length);
      open.emplace(sign * values[way.to], way.to);
    }
  }
  return any;
}

void limitSlope(std::span<float> values, float slope, const TieTable& ties) {
  std::vector<float> low(values.begin(), values.end());
  if (!level(values, ties, slope, 1)) return;
  level(low, ties, slope, -1);
  for (std::size_t i = 0; i < low.size(); ++i) values[i] = 0.5f * (values[i] + low[i]);
}

}  // namespace

Phases measurePhases(const SpineSet& spines, const BoneField& bones, const SkinField& skin,
                     std::span<const vec4> points) {
  const std::size_t size = spines.joints.size() * points.size();
  Phases phases{points.size(), std::vector<float>(size), std::vector<float>(size), std::vector<float>(size)};
  const std::vector<float> blurs = limbBlurs(spines);
  parallelFor((points.size() + kBlock - 1) / kBlock, 1, [&](std::size_t block) {
    PhaseMeter meter(spines, bones, skin, blurs);
    const std::size_t end = std::min(points.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) meter.measure(vec3(points[i]), i, phases);
  });
  return phases;
}

void limitSlopes(Phases& phases, const SpineSet& spines, std::span<const vec4> points,
                 std::span<const Tie> ties) {
  const TieTable tied(points, ties);
  parallelFor(spines.joints.size(), 1, [&](std::size_t j) {
    const SpineJoint& joint = spines.joints[j];
    const auto ofJoint = [&](std::vector<float>& table) {
      return std::span(table).subspan(phases.at(j, 0), phases.pointCount);
    };
    limitSlope(ofJoint(phases.bend), kSlope / joint.arc, tied);
    limitSlope(ofJoint(phases.nearness), kSlope / joint.arc, tied);
    if (joint.spreadsTwist) limitSlope(ofJoint(phases.twist), kTwistSlope / joint.link, tied);
  });
}

}  // namespace vasa
