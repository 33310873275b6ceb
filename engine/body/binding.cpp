#include "body/binding.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "body/arcs.h"
#include "body/belonging.h"
#include "body/kept_binding.h"
#include "body/rebind.h"
#include "body/stillness.h"
#include "body/ties.h"
#include "core/cancellation.h"
#include "core/log.h"

// Along a limb the joints have set in at a point by shares φ_j (bend) and ψ_j (twist), from the root on 1 1 1
// φ 0 0. Where arcs are apart only one of them is between 0 and 1, and the point has one record; where they
// overlap (shoulder, wrist) the point turns about each joint by its share, and has a record for each. A joint
// that has set in implies those before it, hence 1 − (1 − φ_j)(1 − φ_{j+1}) in place of φ_j.
namespace vasa {
namespace {

constexpr float kSmallestTurn = 1e-3f;  // of a joint's motion
constexpr float kSmallestShare = 0.004f;
constexpr std::size_t kMostLimbs = 4;
constexpr float kMostLeftBehind = 0.02f;  // four of the points that are looked at

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

/// Turns the phases of one point at a time into limbs and stations; scratch is kept between them.
class PointBinder {
 public:
  PointBinder(const SpineSet& spines, const Phases& phases)
      : spines_(spines), phases_(phases), children_(spines.joints.size()) {
    for (std::uint32_t j = 0; j < spines.joints.size(); ++j) {
      const JointId parent = spines.joints[j].parent;
      (parent.valid() ? children_[parent.value] : roots_).push_back(j);
    }
  }

  /// The limbs that move a point, at most kMostLimbs, with weights that add up to 1.
  std::span<const LimbShare> bind(std::size_t point) {
    point_ = point;
    shares_.clear();
    chooseLimbs(roots_, 1);
    keepLargest();
    return shares_;
  }

  /// How a point moves with one limb alone.
  std::span<const LimbShare> bindAlong(std::size_t point, JointId tip) {
    point_ = point;
    shares_.clear();
    addLimb(tip, 1);
    return shares_;
  }

 private:
  float phase(const std::vector<float>& table, std::uint32_t joint) const {
    return table[phases_.at(joint, point_)];
  }

  float sumOfNearness(std::span<const std::uint32_t> starts) const {
    float sum = 0;
    for (const std::uint32_t j : starts) sum += phase(phases_.nearness, j);
    return sum;
  }

  /// Shares `weight` among the limbs that start with these joints, by how near they are.
  void chooseLimbs(std::span<const std::uint32_t> starts, float weight) {
    const float sum = sumOfNearness(starts);
    for (const std::uint32_t j : starts) {
      const float share = weight * phase(phases_.nearness, j) / sum;
      if (share < 0.25f * kSmallestShare) continue;
      if (sumOfNearness(children_[j]) > 0)
        chooseLimbs(children_[j], share);
      else
        addLimb({j}, share);
    }
  }

  /// How the point moves with the limb that ends with `tip`.
  void addLimb(JointId tip, float weight) {
    LimbShare limb{{}, weight};
    Station whole{tip, 2};  // the joint nearest to the tip with all before it set in
    float reached = 0;
    for (JointId at = tip; at.valid(); at = spines_.joints[at.value].parent) {
      const SpineJoint& joint = spines_.joints[at.value];
      const float measured = phase(phases_.bend, at.value);
      const float bend = joint.parent.valid() ? 1 - (1 - measured) * (1 - reached) : 1.0f;
      const float twist = bend * (1 - (1 - phase(phases_.twist, at.value)) * (1 - reached));
      // Where the link begins its bend is whole and its twist has not begun: a station, too. A root does not
      // turn.
      const bool twists = twist > kSmallestTurn || bend >= 1 - kSmallestTurn;
      if (joint.spreadsTwist && joint.parent.valid() && twists && twist < 1 - kSmallestTurn)
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
  const Phases& phases_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> roots_;
  std::size_t point_ = 0;
  std::vector<LimbShare> shares_;
};

void appendRecords(std::span<const LimbShare> limbs, std::vector<BindingRecord>& records) {
  std::uint32_t left = kWholeShare;
  for (std::size_t k = 0; k < limbs.size(); ++k) {
    const auto rounded = std::uint32_t(std::lround(limbs[k].weight * float(kWholeShare)));
    const std::uint32_t share = k + 1 == limbs.size() ? left : std::min(rounded, left);
    for (const Station& station : limbs[k].stations) records.emplace_back(station, std::uint16_t(0));
    records.back().share = std::uint16_t(share);
    left -= share;
    if (left == 0) break;
  }
}

Result<Bound> bindAnew(const Body& body, std::span<const vec4> points, std::string_view name,
                       std::span<const Tie> ties) {
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  if (!spines) return spines.error();
  if (points.empty()) return badInput(fmt::format("{}: there are no vessels to bind to {}", name, body.name));
  if (body.skeleton.joints.size() > 65535)
    return badInput(
        fmt::format("{}: {} joints; a body may have 65535", body.name, body.skeleton.joints.size()));
  Binding binding{std::move(*spines), std::uint32_t(points.size()), {}, {}, {}};
  const BoneField bones(body, binding.spines);
  const Result<float> outside = checkBelongs(body, binding.spines, points, name);
  if (!outside) return outside.error();
  chooseArcs(binding.spines, body, bones, points);
  std::vector<vec4> places(points.begin(), points.end());
  for (const AxialBone& bone : body.axialBones) places.emplace_back(bone.place, 0.0f);
  Phases phases = measurePhases(binding.spines, bones, SkinField(body), places);
  limitSlopes(phases, binding.spines, places, ties);

  PointBinder binder(binding.spines, phases);
  for (std::size_t i = 0; i < points.size(); ++i) {
    checkpoint();
    if (i % Binding::kBlock == 0) binding.firstRecord.push_back(std::uint32_t(binding.records.size()));
    appendRecords(binder.bind(i), binding.records);
  }
  for (std::size_t k = 0; k < body.axialBones.size(); ++k) {
    const AxialBone& bone = body.axialBones[k];
    if (bone.frontCarrier.valid())
      binding.axialBones.emplace_back(Station{bone.frontCarrier, 2}, std::uint16_t(kWholeShare));
    else
      appendRecords(binder.bindAlong(points.size() + k, bone.head), binding.axialBones);
  }
  const float behind = shareLeftBehind(body, binding, points);
  return Bound{std::move(binding), behind, *outside};
}

// Where each point's records begin, and behind the last.
std::vector<std::uint32_t> firstRecords(const Binding& binding) {
  std::vector<std::uint32_t> firsts{0};
  std::uint32_t share = 0;
  for (std::uint32_t r = 0; r < binding.records.size(); ++r)
    if ((share += binding.records[r].share) == kWholeShare) share = 0, firsts.push_back(r + 1);
  return firsts;
}

Binding warned(Bound bound, const Body& body, std::string_view name) {
  if (bound.behind > kMostLeftBehind)
    logWarning(fmt::format(
        "{}: {:.0f} % of these vessels stay in the rest pose while {} moves; bind its skin's vertices "
        "to the joints that move it, or leave out meshes that follow other joints",
        name, 100 * bound.behind, body.name));
  if (bound.outside > kToldOutside)
    logWarning(fmt::format(
        "{}: {:.0f} % of these vessels lie outside {} at rest, and move with what is nearest to them; vasa fit "
        "carries vessels from one body to another, vasa place moves them",
        name, 100 * bound.outside, body.name));
  return std::move(bound.binding);
}

}  // namespace

struct Rebinder::Fields {
  Fields(const Body& body, SpineSet of) : spines(std::move(of)), bones(body, spines), skin(body) {}
  SpineSet spines;
  BoneField bones;
  SkinField skin;
};

Rebinder::Rebinder(const Body& body, SpineSet spines)
    : fields_(std::make_unique<Fields>(body, std::move(spines))) {}
Rebinder::~Rebinder() = default;

Binding Rebinder::rebind(const Binding& bound, std::span<const vec4> points,
                         std::span<const Kept> vessels) const {
  std::vector<vec4> others;
  std::vector<Tie> ties;  // along the vessels that changed: what they hang on was no steeper before
  for (const Kept& vessel : vessels) {
    if (vessel.before) continue;
    for (std::uint32_t i = 0; i < vessel.pointCount; ++i) {
      if (i > 0) ties.push_back({std::uint32_t(others.size() - 1), std::uint32_t(others.size())});
      others.push_back(points[vessel.firstPoint + i]);
    }
  }
  Phases phases = measurePhases(fields_->spines, fields_->bones, fields_->skin, others);
  limitSlopes(phases, fields_->spines, others, ties);
  PointBinder binder(fields_->spines, phases);
  const std::vector<std::uint32_t> firsts = firstRecords(bound);
  Binding binding{fields_->spines, std::uint32_t(points.size()), {}, {}, bound.axialBones};
  std::size_t point = 0, other = 0;
  for (const Kept& vessel : vessels)
    for (std::uint32_t i = 0; i < vessel.pointCount; ++i, ++point) {
      if (point % Binding::kBlock == 0) binding.firstRecord.push_back(std::uint32_t(binding.records.size()));
      if (!vessel.before) {
        appendRecords(binder.bind(other++), binding.records);
        continue;
      }
      const std::uint32_t* first = &firsts[*vessel.before + i];
      binding.records.insert(binding.records.end(), bound.records.begin() + first[0],
                             bound.records.begin() + first[1]);
    }
  return binding;
}

Result<Binding> bindPoints(const Body& body, std::span<const vec4> points, std::string_view name,
                           std::span<const Tie> ties) {
  auto made = bindAnew(body, points, name, ties);
  if (!made) return made.error();
  return warned(std::move(*made), body, name);
}

Result<Binding> bind(const Body& body, const Network& network, std::string_view name) {
  const std::uint64_t key = boundKey(body, network);
  if (auto kept = findBound(key, body)) return warned(std::move(*kept), body, name);
  auto made = bindAnew(body, network.points(), name, tiesOf(network));
  if (!made) return made.error();
  keepBound(key, *made);
  return warned(std::move(*made), body, name);
}

}  // namespace vasa
