#include "avoid/sides.h"

#include <algorithm>
#include <cmath>

#include "avoid/correction.h"
#include "avoid/motion_space.h"
#include "collide/contact_search.h"
#include "core/parallel.h"
#include "core/stable_sort.h"
#include "math/direction.h"

namespace vasa {
namespace {

constexpr float kSureTo = 4;  // sums of radii at rest; over as many again the side fades
// Sums of radii apart, below which the side at rest is the less sure.
constexpr float kTooClose = 0.25f;
constexpr float kCrossing = 0.7f;  // |u - v| from which two tubes cross (40 degrees)
constexpr float kAhead = 0.34f;    // cosine of the way to what lies ahead of an end (70 degrees)

// 1 up to 1, 0 from 2 on.
float fadeOut(float x) {
  const float t = std::clamp(x - 1, 0.0f, 1.0f);
  return 1 - t * t * (3 - 2 * t);
}

}  // namespace

vec3 directionAt(const Bezier& tube, float t) { return directionOf(vec3(tube.derivative(t))); }

vec3 sideways(vec3 c, vec3 u, vec3 v) {
  if (glm::dot(u, v) < 0) v = -v;
  const vec3 mean = directionOf(u + v), difference = u - v;
  c -= mean * glm::dot(c, mean);
  return c - glm::dot(c, difference) / std::max(glm::dot(difference, difference), kCrossing * kCrossing) *
                 difference;
}

bool crossOver(vec3 u, vec3 v) { return std::min(glm::length(u - v), glm::length(u + v)) > kCrossing; }

RestSides::RestSides(const Network& network, Interference& interference)
    : network_(&network), interference_(&interference), nearAtRest_(interference.findNearAtRest()) {}

quat RestSides::rotationAt(std::uint32_t tube, float t, std::span<const quat> rotations) const {
  const auto [vessel, span] = interference_->layout().address(tube);
  const std::uint32_t first = network_->vessel(vessel).firstPoint + span;
  const quat a = rotations[first + 1], b = rotations[first + 2];
  return glm::normalize((1 - t) * a + (glm::dot(a, b) < 0 ? -t : t) * b);
}

vec3 RestSides::carried(const Contact& at, std::span<const Bezier> shape,
                        std::span<const quat> rotations) const {
  const vec4 a = interference_->restTubes()[at.i].at(at.s), b = interference_->restTubes()[at.j].at(at.t);
  const vec3 gap = vec3(a) - vec3(b);
  const float distance = glm::length(gap), radii = a.w + b.w;
  if (!(radii > 0) || distance >= 2 * kSureTo * radii || distance < Correction::kNegligible) return vec3(0);
  const vec3 turned =
      0.5f * (rotationAt(at.i, at.s, rotations) * gap + rotationAt(at.j, at.t, rotations) * gap);
  const vec3 side = sideways(turned, directionAt(shape[at.i], at.s), directionAt(shape[at.j], at.t));
  const float apart = glm::length(side), together = glm::length(turned) / distance;
  return directionOf(side) * together * fadeOut(distance / (kSureTo * radii)) *
         std::min(1.0f, apart / (kTooClose * radii));
}

// Tubes that cross, at rest and now, lie as the first two fingers of one hand do, however far they have slid
// along one another; others lie, like these where that is sure, on the side on which they were there. Where
// the two disagree, as of tubes that have turned past one another's direction, nothing is known.
vec3 RestSides::sideOf(const Contact& rest, const Contact& now, std::span<const Bezier> shape,
                       std::span<const quat> rotations) const {
  const vec3 side = carried(now, shape, rotations);
  const std::span<const Bezier> before = interference_->restTubes();
  const vec3 u = directionAt(shape[now.i], now.s), v = directionAt(shape[now.j], now.t),
             restU = directionAt(before[rest.i], rest.s), restV = directionAt(before[rest.j], rest.t);
  if (!crossOver(u, v) || !crossOver(restU, restV)) return side;
  const float radii = before[rest.i].at(rest.s).w + before[rest.j].at(rest.t).w;
  const float hand = glm::dot(rest.normal, glm::normalize(glm::cross(restU, restV))) *
                     std::min(1.0f, (rest.f + radii) / (kTooClose * radii));
  const vec3 across = hand * glm::normalize(glm::cross(u, v));
  return glm::dot(side, across) < -kLeastSure ? vec3(0) : across;
}

// Where the two vessels are nearest now, near the place where they were at rest: over the ends of tubes into
// the next. Nowhere, where that leads to where they are joined.
std::optional<Contact> RestSides::nearestAlong(const Contact& rest, std::span<const Bezier> shape) const {
  const NetworkTubes& layout = interference_->layout();
  const auto nearestFrom = [&](const Contact& at) {
    Contact there = nearestPlaceFrom(shape[at.i], shape[at.j], at.s, at.t);
    there.i = at.i, there.j = at.j;
    return there;
  };
  const auto follow = [&](std::uint32_t& tube, float& at) {
    if ((at > 0 && at < 1) || endsAt(tube, at)) return false;
    tube = at >= 1 ? tube + 1 : tube - 1;
    at = at >= 1 ? 0 : 1;
    return true;
  };
  Contact now = nearestFrom(rest);
  if (layout.address(rest.i).vessel == layout.address(rest.j).vessel) return now;
  for (;;) {
    Contact next = now;
    const bool left = follow(next.i, next.s), right = follow(next.j, next.t);
    if (!left && !right) return now;
    if (layout.neighbours().contains(next.i, next.j)) return std::nullopt;
    next = nearestFrom(next);
    if (next.f >= now.f - Correction::kNegligible) return now;
    now = next;
  }
}

// Whether a vessel ends at a tube's parameter, which is 0 or 1.
bool RestSides::endsAt(std::uint32_t tube, float at) const {
  const auto [vessel, span] = interference_->layout().address(tube);
  return at >= 1 ? span + 1 == network_->vessel(vessel).spanCount() : span == 0;
}

bool RestSides::hasFreeEnd(std::uint32_t tube) const {
  const Vessel& vessel = network_->vessel(interference_->layout().address(tube).vessel);
  return (!vessel.start.valid() && endsAt(tube, 0)) || (!vessel.end.valid() && endsAt(tube, 1));
}

// Whether a place lies ahead of a vessel's end rather than beside it: what is there can go around the end.
bool RestSides::beyondEnd(std::uint32_t tube, float at, vec3 way, std::span<const Bezier> shape) const {
  if ((at > 0 && at < 1) || !endsAt(tube, at)) return false;
  const float ahead = glm::dot(way, directionAt(shape[tube], at)) * (at >= 1 ? 1.0f : -1.0f);
  return ahead > kAhead * glm::length(way);
}

bool RestSides::aheadOfEnd(const Contact& at, vec3 gap, std::span<const Bezier> shape) const {
  return beyondEnd(at.i, at.s, -gap, shape) || beyondEnd(at.j, at.t, gap, shape);
}

void RestSides::find(std::span<const Bezier> shape, std::span<const quat> rotations, Which which,
                     std::vector<Turned>& turned) {
  found_.resize(nearAtRest_.size());
  parallelFor(found_.size(), kGrain, [&](std::size_t k) {
    found_[k].reset();
    const Contact& rest = nearAtRest_[k];
    const auto gapAt = [&](const Contact& at) {
      return vec3(shape[at.i].at(at.s)) - vec3(shape[at.j].at(at.t));
    };
    const bool mayGoAround = which == Which::turned && (hasFreeEnd(rest.i) || hasFreeEnd(rest.j));
    if (!mayGoAround && glm::dot(gapAt(rest), sideOf(rest, rest, shape, rotations)) > 0) return;
    std::optional<Contact> now = nearestAlong(rest, shape);
    if (!now) return;
    const vec3 side = sideOf(rest, *now, shape, rotations), gap = gapAt(*now);
    const float sure = glm::length(side), depth = glm::dot(gap, side) / sure;
    if (!(sure >= kLeastSure) || depth > -Correction::kNegligible) return;
    const bool ahead = aheadOfEnd(*now, gap, shape);
    const bool isChanged = !ahead && isNear(*now, shape) && depth <= kChanged * glm::length(gap);
    if (which == Which::changed && !isChanged) return;
    now->f = depth;
    found_[k] = {*now, side, ahead};
  });
  turned.clear();
  for (const std::optional<Turned>& own : found_)
    if (own) turned.push_back(*own);
  const auto pairOf = [](const Turned& place) { return TubePair{place.at.i, place.at.j}; };
  stableSort(std::span(turned), sortRoom_,
             [&](const Turned& a, const Turned& b) { return pairOf(a) < pairOf(b); });
  turned.erase(std::unique(turned.begin(), turned.end(),
                           [&](const Turned& a, const Turned& b) { return pairOf(a) == pairOf(b); }),
               turned.end());
}

}  // namespace vasa
