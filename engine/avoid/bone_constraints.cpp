#include "avoid/bone_constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vasa {
namespace {

constexpr float kClearanceShare = 0.02f;   // of the radius
constexpr float kLeastClearance = 1e-4f;   // [m]
constexpr float kLeastDiagonal = 1e-4f;    // below it nothing that may move can mend the place
constexpr float kReach = 3;                // how far a multiplier may push on its own: times what is lacking
constexpr float kMore = 1.5f, kMost = 6;   // a limit that was reached in vain grows by so much a round, and in all
constexpr unsigned kPatient = 8;           // ... in the first rounds; after these it
constexpr float kLess = 0.95f;             // falls to this a round
constexpr float kLeastLimit = 1e-4f;       // [m] and asks for no more rounds from here on
// What asks for a longer way than this from where the pose has put a vessel, and was not met at first, comes of where
// the vessel was pushed.
constexpr float kFarthest = 2, kFartherStill = 0.008f;  // radii; [m]
constexpr float kSameWay = 0.9f;  // cosine
constexpr float kFartherThanPosed = 1.5f;
// In turning: the cosine below which one plane is given up for another, and how near along the vessel; and the depth that
// is not too far, wherever the vessel was posed.
constexpr float kContradicts = 0.5f, kBeside = 2, kNearlyOut = 0.004f;  // -; spans; [m]

}  // namespace

BoneConstraints::BoneConstraints(const Network& network, const MotionSpace& space, const NetworkTubes& layout)
    : network_(&network), space_(&space), layout_(&layout) {
  clear();
}

void BoneConstraints::restart() {
  constraints_.clear();
  keys_.clear();
  rows_.clear();
  rounds_ = 0;
}

void BoneConstraints::turnTo(std::span<const BoneContact> places) {
  turning_ = true;
  rounds_ = 1;
  next_.clear();
  nextKeys_.clear();
  for (std::size_t own = 0; own < keys_.size(); ++own) {
    const auto [vessel, span] = layout_->address(keys_[own].tube);
    const float u = float(span) + keys_[own].s;
    if (std::ranges::none_of(places, [&](const BoneContact& place) {
          const auto [other, at] = layout_->address(place.tube);
          return other == vessel && std::abs(float(at) + place.s - u) < kBeside && glm::dot(place.normal, constraints_[own].normal) < kContradicts;
        }))
      keep(own);
  }
  constraints_.swap(next_);
  keys_.swap(nextKeys_);
}

void BoneConstraints::clear() {
  turning_ = false;
  restart();
  letThrough_.assign(network_->vessels().size(), 0);
  lackAtFirst_.assign(network_->vessels().size(), 0.0f);
}

bool BoneConstraints::makeRow(Constraint& constraint) {
  terms_.clear();
  const auto [vessel, span] = layout_->address(constraint.tubes.i);
  space_->addPlace(vessel, span, constraint.s, 1, terms_);
  constraint.row = space_->finish(terms_, rows_);
  return constraint.row.diagonal > kLeastDiagonal;
}

void BoneConstraints::keep(std::size_t own) {
  next_.push_back(constraints_[own]);
  nextKeys_.push_back(keys_[own]);
}

// The plane that is nearest now takes the place of the one before.
void BoneConstraints::renew(Constraint& constraint, const Constraint& before) const {
  constraint.row = before.row;
  constraint.mostLimit = before.mostLimit;
  constraint.limit = before.limit;
  if (before.multiplier >= before.limit)
    constraint.limit = rounds_ < kPatient ? std::min(kMore * before.limit, before.mostLimit) : kLess * before.limit;
  constraint.multiplier = std::min(before.multiplier, constraint.limit);
}

// Of the planes that hold a place, the one that faces the same way.
std::size_t BoneConstraints::sameWay(std::size_t first, std::size_t last, vec3 normal) const {
  std::size_t best = last;
  float most = kSameWay;
  for (std::size_t own = first; own < last; ++own)
    if (const float cosine = glm::dot(constraints_[own].normal, normal); cosine > most) most = cosine, best = own;
  return best;
}

std::size_t BoneConstraints::update(std::span<const BoneContact> places, std::span<const Bezier> shape,
                                    std::span<const Bezier> posedTubes) {
  std::size_t asking = 0, old = 0;
  ++rounds_;
  next_.clear();
  nextKeys_.clear();
  for (const BoneContact& place : places) {
    const Key key{place.tube, place.part, place.s};
    for (; old < keys_.size() && keys_[old] < key; ++old) keep(old);
    std::size_t end = old;
    while (end < keys_.size() && keys_[end] == key) ++end;
    if (letThrough_[layout_->address(place.tube).vessel.value]) continue;
    const float radius = shape[place.tube].at(place.s).w;
    Constraint constraint{.tubes = {place.tube, kNoTube}, .s = place.s, .normal = place.normal};
    constraint.clearance = place.allowed < 0 ? place.allowed : std::max(kClearanceShare * radius, kLeastClearance);
    constraint.distance = radius + constraint.clearance;
    const vec3 posedPlace(posedTubes[place.tube].at(place.s));
    constraint.start = glm::dot(place.normal, posedPlace - place.point);
    float lack = constraint.distance - constraint.start;
    float& posed = lackAtFirst_[layout_->address(place.tube).vessel.value];
    if (rounds_ == 1) posed = std::max(posed, lack);
    const float farthest = rounds_ > 1 ? std::max(kFarthest * radius + kFartherStill, kFartherThanPosed * posed) : std::numeric_limits<float>::infinity();
    if (lack > farthest && place.nearestNormal != vec3(0)) {
      constraint.normal = place.nearestNormal;
      constraint.start = glm::dot(place.nearestNormal, posedPlace - place.nearestPoint);
      lack = constraint.distance - constraint.start;
    }
    const bool nearlyOut = turning_ && place.allowed - place.f < kNearlyOut;
    const bool tooFar = lack > farthest && !nearlyOut;
    const std::size_t same = sameWay(old, end, constraint.normal);
    for (; old < end; ++old) {
      if (tooFar) {
        constraints_[old].limit *= kLess;
        constraints_[old].multiplier = std::min(constraints_[old].multiplier, constraints_[old].limit);
      }
      if (turning_ && !tooFar && old != same && glm::dot(constraints_[old].normal, constraint.normal) < kContradicts) continue;
      if (old != same || tooFar) keep(old);
      else renew(constraint, constraints_[old]);
    }
    if (tooFar) continue;
    if (same == end) {
      if (!makeRow(constraint)) continue;
      constraint.limit = kReach * (constraint.clearance - place.f + radius) / constraint.row.diagonal;
      constraint.mostLimit = kMost * constraint.limit;
    }
    asking += constraint.limit * constraint.row.diagonal > kLeastLimit;
    next_.push_back(constraint);
    nextKeys_.push_back(key);
  }
  for (; old < keys_.size(); ++old) keep(old);
  constraints_.swap(next_);
  keys_.swap(nextKeys_);
  return asking;
}

}  // namespace vasa
