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
constexpr float kSameOfNeighbours = 0.005f;  // ... of neighbours, whose nearest place may be on a slope of f
constexpr float kNearAtRest = 4;           // sums of radii: nearer at rest than this, the rest pose says which side
constexpr float kWrongSide = -0.25f;       // cosine below which two centre lines have changed sides
constexpr float kCrossing = 0.3f;          // share of the radii below which the present direction is not to be trusted
constexpr float kSameDirection = 0.98f;    // ... if their normals are about the same too
constexpr float kNegligible = 2e-6f;       // [m] of violation
constexpr float kLeastDiagonal = 1e-4f;    // below it nothing that may move can mend the place
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

vec3 directionOr(vec3 v, vec3 otherwise) {
  const float length = glm::length(v);
  return length > 1e-9f ? v / length : otherwise;
}

// A direction at right angles to both tubes, on the side of `wish`; where they are parallel, the part of `wish` at
// right angles to them.
vec3 acrossBoth(const Bezier& a, float s, const Bezier& b, float t, vec3 wish, vec3 otherwise) {
  const vec3 u = directionOr(vec3(a.derivative(s)), vec3(0)), v = directionOr(vec3(b.derivative(t)), vec3(0));
  const vec3 across = glm::cross(u, v);
  if (glm::length(across) > 0.5f) return glm::normalize(glm::dot(across, wish) < 0 ? -across : across);
  return directionOr(wish - glm::dot(wish, u) * u, otherwise);
}

}  // namespace

ConstraintPool::ConstraintPool(const Network& network, const MotionSpace& space, const Interference& interference)
    : network_(&network), space_(&space), interference_(&interference) {}

void ConstraintPool::clear() {
  constraints_.clear();
}

quat ConstraintPool::rotationAt(std::uint32_t tube, float t, const PosedNetwork& posed) const {
  const auto [vessel, span] = interference_->layout().address(tube);
  return posed.rotations[network_->vessel(vessel).firstPoint + span + (t < 0.5f ? 1 : 2)];
}

vec3 ConstraintPool::posedPlace(std::uint32_t tube, float t, const PosedNetwork& posed) const {
  const auto [vessel, span] = interference_->layout().address(tube);
  const Vessel& own = network_->vessel(vessel);
  return vec3(bezierOfSpan(posed.points.subspan(own.firstPoint, own.pointCount), span).at(t));
}

ConstraintPool::Side ConstraintPool::sideOf(const Interference::Place& place, float s, float t,
                                            std::span<const Bezier> shape, const PosedNetwork& posed) const {
  const std::uint32_t i = place.contact.i, j = place.contact.j;
  const vec4 a = shape[i].at(s), b = shape[j].at(t);
  const vec4 restA = interference_->restTubes()[i].at(s), restB = interference_->restTubes()[j].at(t);
  const vec3 gap = vec3(a) - vec3(b), restGap = vec3(restA) - vec3(restB);
  const float distance = glm::length(gap), radii = a.w + b.w;
  const float restDistance = glm::length(restGap), restRadii = restA.w + restB.w;
  const vec3 carried = directionOr(rotationAt(i, s, posed) * restGap + rotationAt(j, t, posed) * restGap, vec3(0));
  const bool sided = restDistance < kNearAtRest * restRadii && restDistance > 0.1f * restRadii && carried != vec3(0);

  vec3 normal = directionOr(gap, acrossBoth(shape[i], s, shape[j], t, place.contact.normal, place.contact.normal));
  if (sided && distance < kCrossing * radii) {
    const vec3 across = acrossBoth(shape[i], s, shape[j], t, carried, normal);
    normal = directionOr(glm::mix(across, normal, std::max(glm::dot(normal, across), 0.0f) * distance / (kCrossing * radii)), across);
  } else if (sided && glm::dot(carried, normal) < kWrongSide) {
    normal = -normal;
  }
  return {normal, distanceFor({i, j}, s, t, shape), glm::dot(normal, gap)};
}

float ConstraintPool::distanceFor(TubePair tubes, float s, float t, std::span<const Bezier> shape) const {
  const vec4 restA = interference_->restTubes()[tubes.i].at(s), restB = interference_->restTubes()[tubes.j].at(t);
  const float radii = shape[tubes.i].at(s).w + shape[tubes.j].at(t).w;
  const float restClearance = glm::distance(vec3(restA), vec3(restB)) - restA.w - restB.w;
  return radii + std::min(std::max(kClearanceShare * radii, kLeastClearance), restClearance);
}

void ConstraintPool::refresh(std::span<const Bezier> shape) {
  for (Constraint& constraint : constraints_)
    constraint.distance = distanceFor(constraint.tubes, constraint.s, constraint.t, shape);
}

void ConstraintPool::propose(const Interference::Place& place, std::span<const Bezier> shape, const PosedNetwork& posed,
                             std::vector<Constraint>& found) const {
  const Contact& contact = place.contact;
  std::array<std::pair<float, float>, kSamples.size() + 1> where{{{contact.s, contact.t}}};
  std::size_t count = 1;
  if (!place.neighbours)
    for (const float s : kSamples)
      where[count++] = {s, nearestParameter(shape[contact.j], vec3(shape[contact.i].at(s)))};
  for (std::size_t k = 0; k < count; ++k) {
    const auto [s, t] = where[k];
    const Side side = sideOf(place, s, t, shape, posed);
    // A point to the side of a tube's end does not say anything about the two tubes' sides.
    const vec3 gap = vec3(shape[contact.i].at(s)) - vec3(shape[contact.j].at(t));
    if (k > 0 && glm::length(gap) >= side.distance) continue;
    if (side.present >= side.distance - kNegligible) continue;
    Constraint constraint{{contact.i, contact.j}, s, t, side.normal, side.distance};
    constraint.start = glm::dot(side.normal, posedPlace(contact.i, s, posed) - posedPlace(contact.j, t, posed));
    const auto same = [&](const Constraint& other) {
      return std::abs(other.s - s) < kSameParameter && std::abs(other.t - t) < kSameParameter;
    };
    if (std::any_of(found.begin(), found.end(), same) || known(constraint, place.neighbours ? kSameOfNeighbours : kSameParameter)) continue;
    const auto [vesselI, spanI] = interference_->layout().address(contact.i);
    const auto [vesselJ, spanJ] = interference_->layout().address(contact.j);
    space_->addPlace(vesselI, spanI, s, 1, constraint.row.terms);
    space_->addPlace(vesselJ, spanJ, t, -1, constraint.row.terms);
    space_->finish(constraint.row);
    if (constraint.row.diagonal > kLeastDiagonal) found.push_back(std::move(constraint));
  }
}

bool ConstraintPool::known(const Constraint& wanted, float apart) const {
  auto own = std::lower_bound(constraints_.begin(), constraints_.end(), wanted.tubes,
                              [](const Constraint& a, TubePair b) { return a.tubes < b; });
  for (; own != constraints_.end() && own->tubes == wanted.tubes; ++own)
    if (std::abs(own->s - wanted.s) < apart && std::abs(own->t - wanted.t) < apart &&
        glm::dot(own->normal, wanted.normal) > kSameDirection)
      return true;
  return false;
}

std::size_t ConstraintPool::add(std::span<const Interference::Place> places, std::span<const Bezier> shape,
                                const PosedNetwork& posed) {
  std::vector<std::vector<Constraint>> found(places.size());
  parallelFor(places.size(), 16, [&](std::size_t k) { propose(places[k], shape, posed, found[k]); });
  const std::size_t before = constraints_.size();
  for (auto& own : found)
    for (Constraint& constraint : own) constraints_.push_back(std::move(constraint));
  std::inplace_merge(constraints_.begin(), constraints_.begin() + std::ptrdiff_t(before), constraints_.end(),
                     [](const Constraint& a, const Constraint& b) { return a.tubes < b.tubes; });
  return constraints_.size() - before;
}

}  // namespace vasa
