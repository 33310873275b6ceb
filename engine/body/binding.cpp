#include "body/binding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "body/arcs.h"
#include "body/belonging.h"
#include "body/bone_field.h"
#include "core/parallel.h"

// A point's place along a limb is the sum of what the limb's joints have set in at it: σ = Σ φ_j + ψ_j from
// the root to the tip, counted in whole joints. With arcs apart, at most one term is between 0 and 1; where
// arcs overlap, the joints set in one after the other. Either way σ, and with it the station, is continuous
// in the point. A joint far down the limb that has set in entirely implies all joints before it.
namespace vasa {
namespace {

constexpr float kSoftening = 0.2f;
constexpr float kNarrowArc = 0.6f;      // of the way between the bones before and behind a joint
constexpr float kNarrowestArc = 0.25f;  // of the arc
constexpr float kNearness = 0.65f;  // a limb takes part if the nearest is nearer than it by no more than this
constexpr float kLimbBlur = 0.02f;  // of the limbs' length, added to the distances that are compared
constexpr float kSmallestTurn = 1e-3f;  // of a joint's motion
constexpr float kSmallestShare = 0.004f;
constexpr std::size_t kMostLimbs = 4;
constexpr float kTwistTilt = 8;  // largest ratio by which nearness to one bone tilts the spread of twist

float smoothstep(float x) {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

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

/// How a point moves with one limb: the stations of the joints that have set in partly, the deepest first.
struct LimbShare {
  std::vector<Station> stations;
  float weight;
};

bool alike(const LimbShare& a, const LimbShare& b) {
  return std::equal(a.stations.begin(), a.stations.end(), b.stations.begin(), b.stations.end(),
                    [](const Station& s, const Station& t) {
                      return s.joint == t.joint && std::abs(s.along - t.along) < kSmallestTurn;
                    });
}

/// Binds single points; scratch is kept between them.
class PointBinder {
 public:
  PointBinder(const SpineSet& spines, const BoneField& bones)
      : spines_(spines),
        bones_(bones),
        own_(spines.joints.size()),
        behind_(own_),
        before_(own_),
        bend_(own_),
        twist_(own_),
        limbShare_(own_),
        lengthBelow_(limbLengths(spines)),
        children_(spines.joints.size()) {
    for (std::uint32_t j = 0; j < spines.joints.size(); ++j) {
      const JointId parent = spines.joints[j].parent;
      (parent.valid() ? children_[parent.value] : roots_).push_back(j);
    }
  }

  /// The limbs that move p, at most kMostLimbs, with weights that add up to 1.
  std::span<const LimbShare> bind(vec3 p) {
    bones_.distances(p, own_);
    distancesAcrossJoints(spines_, own_, behind_, before_);
    for (std::size_t j = 0; j < own_.size(); ++j) measureJoint(j, p);
    shares_.clear();
    chooseLimbs(roots_, 1);
    keepLargest();
    return shares_;
  }

 private:
  void measureJoint(std::size_t j, vec3 p) {
    const SpineJoint& joint = spines_.joints[j];
    bend_[j] = 1;
    twist_[j] = 1;
    if (behind_[j] >= BoneField::kFar)
      bend_[j] = 0;
    else if (joint.parent.valid() && before_[j] < BoneField::kFar)
      bend_[j] = smoothstep(0.5f + beyond(before_[j], behind_[j]) / arcAt(j, p));
    if (!joint.spreadsTwist) return;
    const float way = smoothstep(glm::dot(p - joint.centre, joint.axis) / joint.link);
    float tilt = 1;
    if (bones_.fromMeshes())
      tilt = std::clamp(behind_[j] / std::max(before_[j], 1e-6f), 1 / kTwistTilt, kTwistTilt);
    twist_[j] = way / (way + tilt * (1 - way));
  }

  /// Where the bones before and behind come close again away from the joint, as those of an arm beside the
  /// chest, the arc narrows until each bone keeps what is on it.
  float arcAt(std::size_t j, vec3 p) const {
    const SpineJoint& joint = spines_.joints[j];
    const float between = before_[j] + behind_[j], away = glm::distance(p, joint.centre);
    const float narrow = std::clamp(kNarrowArc * between, kNarrowestArc * joint.arc, joint.arc);
    const float share =
        smoothstep(2 * away / joint.arc - 1) * smoothstep(2 - 2 * between / std::max(away, 1e-6f));
    return glm::mix(joint.arc, narrow, share);
  }

  /// Shares `weight` among the limbs that start with these joints, by how near they are.
  void chooseLimbs(std::span<const std::uint32_t> starts, float weight) {
    float nearest = BoneField::kFar;
    for (const std::uint32_t j : starts) nearest = std::min(nearest, behind_[j]);
    float sum = 0, blur = 1e-6f;
    for (const std::uint32_t j : starts) blur = std::max(blur, kLimbBlur * lengthBelow_[j]);
    for (const std::uint32_t j : starts) {
      const float nearness = behind_[j] >= BoneField::kFar ? 0 : (nearest + blur) / (behind_[j] + blur);
      limbShare_[j] = smoothstep((nearness - kNearness) / (1 - kNearness));
      sum += limbShare_[j];
    }
    for (const std::uint32_t j : starts) {
      const float share = weight * limbShare_[j] / sum;
      if (share < 0.25f * kSmallestShare) continue;
      const std::vector<std::uint32_t>& behind = children_[j];
      const bool goesOn = std::any_of(behind.begin(), behind.end(),
                                      [&](std::uint32_t c) { return behind_[c] < BoneField::kFar; });
      if (goesOn)
        chooseLimbs(behind, share);
      else
        addLimb({j}, share);
    }
  }

  /// How p moves with the limb that ends with `tip`.
  void addLimb(JointId tip, float weight) {
    LimbShare limb{{}, weight};
    Station whole{tip, 2};  // the joint nearest to the tip with all before it set in
    float reached = 0;
    for (JointId at = tip; at.valid(); at = spines_.joints[at.value].parent) {
      const SpineJoint& joint = spines_.joints[at.value];
      const float bend = joint.parent.valid() ? 1 - (1 - bend_[at.value]) * (1 - reached) : 1.0f;
      const float twist = joint.spreadsTwist ? bend * (1 - (1 - twist_[at.value]) * (1 - reached)) : 1.0f;
      if (joint.spreadsTwist && twist > kSmallestTurn && twist < 1 - kSmallestTurn)
        limb.stations.push_back({at, 1 + twist});
      if (bend > kSmallestTurn && bend < 1 - kSmallestTurn) limb.stations.push_back({at, bend});
      if (bend <= kSmallestTurn) whole = {joint.parent, 2};
      reached = bend;
    }
    if (limb.stations.empty()) limb.stations.push_back(whole);
    merge(std::move(limb));
  }

  void merge(LimbShare added) {
    for (LimbShare& share : shares_)
      if (alike(share, added)) {
        share.weight += added.weight;
        return;
      }
    shares_.push_back(std::move(added));
  }

  void keepLargest() {
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const LimbShare& a, const LimbShare& b) { return a.weight > b.weight; });
    while (shares_.size() > 1 && (shares_.size() > kMostLimbs || shares_.back().weight < kSmallestShare))
      shares_.pop_back();
    float sum = 0;
    for (const LimbShare& share : shares_) sum += share.weight;
    for (LimbShare& share : shares_) share.weight /= sum;
  }

  const SpineSet& spines_;
  const BoneField& bones_;
  std::vector<float> own_, behind_, before_, bend_, twist_, limbShare_, lengthBelow_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> roots_;
  std::vector<LimbShare> shares_;
};

void appendRecords(std::span<const LimbShare> limbs, std::vector<BindingRecord>& records) {
  std::uint32_t left = kWholeShare;
  for (std::size_t k = 0; k < limbs.size(); ++k) {
    const auto rounded = std::uint32_t(std::lround(limbs[k].weight * float(kWholeShare)));
    const std::uint32_t share = k + 1 == limbs.size() ? left : std::min(rounded, left);
    for (const Station& station : limbs[k].stations)
      records.push_back({station.along, std::uint16_t(station.joint.value), 0});
    records.back().share = std::uint16_t(share);
    left -= share;
    if (left == 0) break;
  }
}

}  // namespace

Result<Binding> bindPoints(const Body& body, std::span<const vec4> points, std::string_view name) {
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  if (!spines) return spines.error();
  if (points.empty()) return badInput(fmt::format("{}: there are no vessels to bind to {}", name, body.name));
  if (body.skeleton.joints.size() > 65535)
    return badInput(
        fmt::format("{}: {} joints; a body may have 65535", body.name, body.skeleton.joints.size()));
  Binding binding{std::move(*spines), std::uint32_t(points.size()), {}, {}};
  const BoneField bones(body, binding.spines);
  if (const Result<void> belongs = checkBelongs(body, binding.spines, points, name); !belongs)
    return belongs.error();
  chooseArcs(binding.spines, body, bones, points);

  const std::size_t blocks = (points.size() + Binding::kBlock - 1) / Binding::kBlock;
  std::vector<std::vector<BindingRecord>> parts(blocks);
  parallelFor(blocks, 1, [&](std::size_t block) {
    PointBinder binder(binding.spines, bones);
    const std::size_t end = std::min(points.size(), (block + 1) * Binding::kBlock);
    for (std::size_t i = block * Binding::kBlock; i < end; ++i)
      appendRecords(binder.bind(vec3(points[i])), parts[block]);
  });
  for (const std::vector<BindingRecord>& part : parts) {
    binding.firstRecord.push_back(std::uint32_t(binding.records.size()));
    binding.records.insert(binding.records.end(), part.begin(), part.end());
  }
  return binding;
}

Result<Binding> bind(const Body& body, const Network& network, std::string_view name) {
  return bindPoints(body, network.points(), name);
}

}  // namespace vasa
