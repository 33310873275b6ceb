#include "avoid/constraints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kClearanceShare = 0.02f;   // of the sum of the radii
constexpr float kLeastClearance = 1e-5f;   // [m]
constexpr float kSameParameter = 0.04f;    // constraints of one pair closer than this in s and t are one
constexpr float kSameDirection = 0.98f;    // ... if their normals are about the same too
constexpr float kNegligible = 2e-6f;       // [m] of violation
constexpr float kLeastDiagonal = 1e-4f;    // below it nothing that may move can mend the place
constexpr float kReach = 2;                // how far a multiplier may push on its own: times what is lacking
constexpr float kReachBack = 6;            // ... where two tubes are on the wrong side of one another
// What asks for a longer way than this from where the pose has put a vessel, and was not met there, comes of where the
// vessel was pushed.
constexpr float kFarthest = 2, kFartherStill = 0.008f;  // radii; [m]
constexpr std::uint32_t kAlong = 2;        // spans within which two vessels keep to one side of one another
constexpr float kStretch = 8;              // spans, along both: places that share one side
constexpr float kSure = 0.3f;              // length of evidence that counts
constexpr float kMore = 1.5f;              // a limit that was reached in vain grows by so much a round ...
constexpr float kMost = 2;                 // ... and in all
constexpr std::array<float, 4> kSamples{0, 1 / 3.0f, 2 / 3.0f, 1};

// The parameter of the point on `tube` nearest to p: the best of some samples, then Newton on the squared distance.
float nearestParameter(const Bezier& tube, vec3 p) {
  float best = 0, least = std::numeric_limits<float>::infinity();
  for (int k = 0; k <= 8; ++k) {
    const vec3 gap = vec3(tube.at(float(k) / 8)) - p;
    if (glm::dot(gap, gap) < least) least = glm::dot(gap, gap), best = float(k) / 8;
  }
  for (int step = 0; step < 3; ++step) {
    const vec3 gap = vec3(tube.at(best)) - p, first(tube.derivative(best)), second(tube.secondDerivative(best));
    const float speed = glm::dot(first, first), curvature = std::max(speed + glm::dot(gap, second), 0.2f * speed);
    if (!(curvature > 0)) break;
    best = std::clamp(best - glm::dot(gap, first) / curvature, 0.0f, 1.0f);
  }
  return best;
}

}  // namespace

ConstraintPool::ConstraintPool(const Network& network, const MotionSpace& space, const Interference& interference,
                               const RestSides& sides)
    : network_(&network), space_(&space), interference_(&interference), sides_(&sides) {
  clear();
}

void ConstraintPool::restart() {
  constraints_.clear();
  rows_.clear();
  rounds_ = 0;
}

void ConstraintPool::clear() {
  restart();
  asTheyLie_.clear();
}

void ConstraintPool::partAsTheyLie(std::span<const Interference::Place> places) {
  for (const Interference::Place& place : places) asTheyLie_.push_back(vesselsOf({place.contact.i, place.contact.j}));
  std::ranges::sort(asTheyLie_);
  const auto [first, last] = std::ranges::unique(asTheyLie_);
  asTheyLie_.erase(first, last);
  std::erase_if(constraints_, [&](const Constraint& constraint) { return partedAsTheyLie(constraint.tubes); });
}

void ConstraintPool::forget(std::span<const Contact> changed) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Contact& contact : changed) pairs.push_back(vesselsOf({contact.i, contact.j}));
  std::ranges::sort(pairs);
  std::erase_if(constraints_, [&](const Constraint& constraint) { return std::ranges::binary_search(pairs, vesselsOf(constraint.tubes)); });
  std::erase_if(asTheyLie_, [&](const auto& pair) { return std::ranges::binary_search(pairs, pair); });
}

std::pair<std::uint32_t, std::uint32_t> ConstraintPool::vesselsOf(TubePair tubes) const {
  const NetworkTubes& layout = interference_->layout();
  return {layout.address(tubes.i).vessel.value, layout.address(tubes.j).vessel.value};
}

bool ConstraintPool::partedAsTheyLie(TubePair tubes) const {
  return std::ranges::binary_search(asTheyLie_, vesselsOf(tubes));
}

vec3 ConstraintPool::posedPlace(std::uint32_t tube, float t, const PosedVessels& posed) const {
  const auto [vessel, span] = interference_->layout().address(tube);
  const Vessel& own = network_->vessel(vessel);
  return vec3(bezierOfSpan(posed.points.subspan(own.firstPoint, own.pointCount), span).at(t));
}

float ConstraintPool::clearanceFor(TubePair tubes, float s, float t, float radii) const {
  const vec4 restA = interference_->restTubes()[tubes.i].at(s), restB = interference_->restTubes()[tubes.j].at(t);
  const float atRest = glm::distance(vec3(restA), vec3(restB)) - restA.w - restB.w;
  const float wanted = std::max(kClearanceShare * radii, kLeastClearance);
  return std::min(wanted, atRest < 0 ? atRest : std::max(atRest, kLeastClearance));
}

bool ConstraintPool::refresh(std::span<const Bezier> shape) {
  bool grew = false;
  ++rounds_;
  for (Constraint& constraint : constraints_) {
    constraint.distance = shape[constraint.tubes.i].at(constraint.s).w + constraint.clearance;
    constraint.distance += shape[constraint.tubes.j].at(constraint.t).w;
    if (constraint.multiplier < constraint.limit || constraint.limit >= constraint.mostLimit) continue;
    constraint.limit = std::min(kMore * constraint.limit, constraint.mostLimit);
    grew = true;
  }
  return grew;
}

ConstraintPool::Evidence ConstraintPool::evidenceAt(const Contact& contact) const {
  const auto [vesselI, spanI] = interference_->layout().address(contact.i);
  const auto [vesselJ, spanJ] = interference_->layout().address(contact.j);
  return {vesselI.value, vesselJ.value, float(spanI) + contact.s, float(spanJ) + contact.t, vec3(0)};
}

void ConstraintPool::gather(std::span<const Interference::Place> places, std::span<const Contact> changed,
                            std::span<const Bezier> shape, const PosedVessels& posed) {
  evidence_.clear();
  const auto take = [&](const Contact& contact) {
    Evidence evidence = evidenceAt(contact);
    evidence.side = sides_->carried({contact.i, contact.j, contact.s, contact.t}, shape, posed.rotations);
    if (evidence.side != vec3(0)) evidence_.push_back(evidence);
  };
  for (const Interference::Place& place : places)
    if (place.interferes()) take(place.contact);
  for (const Contact& contact : changed) take(contact);
  std::stable_sort(evidence_.begin(), evidence_.end(), [](const Evidence& a, const Evidence& b) {
    return std::pair{a.vesselI, a.vesselJ} < std::pair{b.vesselI, b.vesselJ};
  });
}

// The side of two vessels over the whole stretch where they are in one another's way: one place alone may say nothing,
// or the wrong thing where they cross.
vec3 ConstraintPool::evidenceAround(const Contact& contact) const {
  const Evidence here = evidenceAt(contact);
  const std::pair vessels{here.vesselI, here.vesselJ};
  auto own = std::lower_bound(evidence_.begin(), evidence_.end(), vessels,
                              [](const Evidence& a, const auto& b) { return std::pair{a.vesselI, a.vesselJ} < b; });
  vec3 sum(0);
  for (; own != evidence_.end() && std::pair{own->vesselI, own->vesselJ} == vessels; ++own)
    if (std::abs(own->u - here.u) + std::abs(own->v - here.v) < kStretch) sum += own->side;
  return sum;
}

void ConstraintPool::propose(const Contact& contact, bool changed, std::span<const Bezier> shape,
                             const PosedVessels& posed, Proposals& found) const {
  const auto [i, j, contactS, contactT, f, contactNormal] = contact;
  const bool asTheyLie = partedAsTheyLie({contact.i, contact.j});
  if (asTheyLie && changed) return;
  const vec3 around = evidenceAround(contact);
  std::array<std::pair<float, float>, kPlaces> where{{{contactS, contactT}}};
  for (std::size_t k = 0; k < kSamples.size(); ++k)
    where[k + 1] = {kSamples[k], nearestParameter(shape[j], vec3(shape[i].at(kSamples[k])))};
  for (std::size_t k = 0; k < where.size(); ++k) {
    const auto [s, t] = where[k];
    const vec4 a = shape[i].at(s), b = shape[j].at(t);
    const vec3 gap = vec3(a) - vec3(b);
    const float clearance = clearanceFor({i, j}, s, t, a.w + b.w), distance = a.w + b.w + clearance;
    const Constraint* before = nearest({i, j}, s, t);
    const vec3 settled = glm::length(around) > kSure || !before ? around : before->normal;
    const vec3 side = asTheyLie ? vec3(0) : sides_->belongs({i, j, s, t}, shape, posed, glm::length(settled) > kSure ? &settled : nullptr);
    // A point to the side of a tube's end does not say anything about the two tubes' sides.
    const bool wrong = changed && glm::dot(gap, side) < 0;
    if (k > 0 && !wrong && glm::length(gap) >= distance) continue;
    const float sure = glm::length(side);
    const bool back = wrong && k == 0 && sure > kSure;  // not only off one another, but back
    const vec3 normal = back ? side / sure : partingDirection(gap, side, distance, contactNormal);
    const float lack = distance - glm::dot(normal, gap);
    if (lack <= kNegligible) continue;
    Constraint constraint{.tubes = {i, j}, .s = s, .t = t, .normal = normal, .clearance = clearance, .distance = distance};
    constraint.start = glm::dot(normal, posedPlace(i, s, posed) - posedPlace(j, t, posed));
    if (rounds_ > 1 && distance - constraint.start > kFarthest * (a.w + b.w) + kFartherStill) continue;
    constraint.limit = (back ? kReachBack : kReach) * (lack + a.w + b.w);
    const auto own = std::span(found.constraints).first(found.count);
    const auto same = [&](const Constraint& other) {
      return std::abs(other.s - s) < kSameParameter && std::abs(other.t - t) < kSameParameter;
    };
    if (std::any_of(own.begin(), own.end(), same) || known(constraint)) continue;
    found.constraints[found.count++] = constraint;
  }
}

bool ConstraintPool::known(const Constraint& wanted) const {
  auto own = std::lower_bound(constraints_.begin(), constraints_.end(), wanted.tubes,
                              [](const Constraint& a, TubePair b) { return a.tubes < b; });
  for (; own != constraints_.end() && own->tubes == wanted.tubes; ++own)
    if (std::abs(own->s - wanted.s) < kSameParameter && std::abs(own->t - wanted.t) < kSameParameter &&
        glm::dot(own->normal, wanted.normal) > kSameDirection)
      return true;
  return false;
}

// Gives a row to a constraint and takes it in.
void ConstraintPool::take(Constraint& constraint) {
  terms_.clear();
  const auto [vesselI, spanI] = interference_->layout().address(constraint.tubes.i);
  space_->addPlace(vesselI, spanI, constraint.s, 1, terms_);
  const auto [vesselJ, spanJ] = interference_->layout().address(constraint.tubes.j);
  space_->addPlace(vesselJ, spanJ, constraint.t, -1, terms_);
  constraint.row = space_->finish(terms_, rows_);
  if (constraint.row.diagonal <= kLeastDiagonal) return;
  constraint.limit /= constraint.row.diagonal;
  constraint.mostLimit = kMost * constraint.limit;
  constraints_.push_back(constraint);
}

// The constraint between the same two vessels that is nearest along them: it has settled on which side they belong.
const Constraint* ConstraintPool::nearest(TubePair tubes, float s, float t) const {
  const NetworkTubes& layout = interference_->layout();
  const auto spansOf = [&](std::uint32_t tube) {
    const auto [vessel, span] = layout.address(tube);
    const std::uint32_t count = network_->vessel(vessel).spanCount();
    return std::pair{tube - std::min(span, kAlong), tube + std::min(count - 1 - span, kAlong)};
  };
  const auto [firstI, lastI] = spansOf(tubes.i);
  const auto [firstJ, lastJ] = spansOf(tubes.j);
  const Constraint* best = nullptr;
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = firstI; i <= lastI; ++i) {
    auto own = std::lower_bound(constraints_.begin(), constraints_.end(), TubePair{i, firstJ},
                                [](const Constraint& a, TubePair b) { return a.tubes < b; });
    for (; own != constraints_.end() && own->tubes.i == i && own->tubes.j <= lastJ; ++own) {
      const float away = std::abs(float(i) + own->s - float(tubes.i) - s) + std::abs(float(own->tubes.j) + own->t - float(tubes.j) - t);
      if (away < least) least = away, best = &*own;
    }
  }
  return best;
}

std::size_t ConstraintPool::sortIn(std::size_t before) {
  std::inplace_merge(constraints_.begin(), constraints_.begin() + std::ptrdiff_t(before), constraints_.end(),
                     [](const Constraint& a, const Constraint& b) { return a.tubes < b.tubes; });
  return constraints_.size() - before;
}

std::size_t ConstraintPool::add(std::span<const Interference::Place> places, std::span<const Contact> changed,
                                std::span<const Bezier> shape, const PosedVessels& posed) {
  std::size_t added = 0;
  gather(places, changed, shape, posed);
  const auto addAll = [&](std::size_t count, const auto& proposeOne) {
    proposals_.resize(std::max(proposals_.size(), count));
    parallelFor(count, 16, [&](std::size_t k) {
      proposals_[k].count = 0;
      proposeOne(k, proposals_[k]);
    });
    const std::size_t before = constraints_.size();
    for (Proposals& proposals : std::span(proposals_).first(count))
      for (Constraint& constraint : std::span(proposals.constraints).first(proposals.count)) take(constraint);
    added += sortIn(before);
  };
  addAll(places.size(), [&](std::size_t k, Proposals& found) {
    if (places[k].interferes()) propose(places[k].contact, false, shape, posed, found);
  });
  addAll(changed.size(), [&](std::size_t k, Proposals& found) { propose(changed[k], true, shape, posed, found); });
  return added;
}

}  // namespace vasa
