#include "surface/fork_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/sweep_table.h"

namespace vasa {
namespace {

constexpr int kSearchSteps = 256;
constexpr float kHold = 1.05f;  // columns and rows stay outside the hole
constexpr float kRowMargin = 1.2f;
constexpr float kLeastStrip = 0.04f;  // of s, between a ring and the next row

struct SpanPlace {
  std::uint32_t point, spanClass, span;
  float t;
};

SpanPlace spanPlace(const Network& network, const LinePlace& place) {
  const Vessel& vessel = network.vessels()[place.vessel];
  const auto [span, t] = locate(place.u, vessel.spanCount());
  return {vessel.firstPoint + span, spanClassOf(span, vessel.spanCount()), span, t};
}

LinePlace turned(LinePlace place, bool around) {
  place.reversed = place.reversed != around;
  return place;
}

// d/ds of the trunk from d/du of a ring's vessel.
float scaleAt(const Network& network, const LinePlace& place, const ForkCourse& course) {
  if (course.low.vessel == course.high.vessel) return course.high.u - course.low.u;
  const vec3 speed(evaluateDerivative(network.pointsOf(network.vessels()[place.vessel]), place.u));
  return (place.reversed ? -1.0f : 1.0f) * course.length / std::max(glm::length(speed), 1e-9f);
}

Bezier trunkAtRest(const Network& network, const ForkCourse& course, const shared::ForkRecord& record) {
  const auto end = [&](const LinePlace& place, float scale) {
    const auto points = network.pointsOf(network.vessels()[place.vessel]);
    return std::pair(evaluate(points, place.u), scale * evaluateDerivative(points, place.u));
  };
  const auto [a, ta] = end(course.low, record.scaleA);
  const auto [b, tb] = end(course.high, record.scaleB);
  return {{a, a + ta / 3.0f, b - tb / 3.0f, b}};
}

float nearestParameter(const Bezier& trunk, vec3 point) {
  float nearest = 1e30f, best = 0.5f;
  for (int i = 0; i <= kSearchSteps; ++i) {
    const float s = float(i) / kSearchSteps, distance = glm::distance(vec3(trunk.at(s)), point);
    if (distance < nearest) nearest = distance, best = s;
  }
  return std::clamp(best, 0.1f, 0.9f);
}

shared::ForkBranch branchRecord(const Network& network, const ForkCourse::Branch& branch,
                                const Bezier& trunk) {
  shared::ForkBranch record{};
  record.ring = forkRingAt(network, turned(branch.ring, branch.last));
  record.vessel = branch.ring.vessel;
  const SpanPlace cross = spanPlace(network, branch.cross);
  record.crossPoint = cross.point;
  record.crossClass = cross.spanClass;
  record.crossT = cross.t;
  record.centre = nearestParameter(trunk, branch.centre);
  record.holeAround = branch.around;
  record.cornerAround = branch.cornerAround;
  record.cornerAlong = branch.cornerAlong;
  record.holeAlong = branch.hole / std::max(glm::length(vec3(trunk.derivative(record.centre))), 1e-9f);
  const float hold = kHold * std::asin(branch.around) + 0.01f;
  record.window = hold / kPi;
  record.holdCos = std::cos(hold);
  record.holdSin = std::sin(hold);
  return record;
}

}  // namespace

shared::ForkRing forkRingAt(const Network& network, const LinePlace& place) {
  const Vessel& vessel = network.vessels()[place.vessel];
  const SpanPlace at = spanPlace(network, place);
  return {at.point,
          firstKnot(network, {place.vessel}) + at.span,
          at.spanClass,
          vessel.firstPoint,
          vessel.firstPoint + vessel.pointCount - 1,
          at.t,
          place.reversed ? -1.0f : 1.0f};
}

std::uint32_t spanClassOf(std::uint32_t span, std::uint32_t spans) {
  return 3 * std::min(span, 2u) + std::min(spans - 1 - span, 2u);
}

shared::ForkRecord makeForkRecord(const Network& network, const ForkCourse& course,
                                  std::vector<shared::ForkBranch>& branches) {
  assert(course.branches.size() <= shared::kMostBranches);
  shared::ForkRecord record{};
  record.a = forkRingAt(network, course.low);
  record.b = forkRingAt(network, course.high);
  record.scaleA = scaleAt(network, course.low, course);
  record.scaleB = scaleAt(network, course.high, course);
  record.vesselA = course.low.vessel;
  record.vesselB = course.high.vessel;
  record.firstBranch = std::uint32_t(branches.size());
  record.branchCount = std::uint32_t(course.branches.size());
  record.row1 = 0.25f;
  record.row3 = 0.75f;
  if (record.branchCount > 0) {
    const Bezier trunk = trunkAtRest(network, course, record);
    float low = 1, high = 0;
    for (const ForkCourse::Branch& branch : course.branches) {
      const shared::ForkBranch& added = branches.emplace_back(branchRecord(network, branch, trunk));
      low = std::min(low, added.centre - kRowMargin * added.holeAlong);
      high = std::max(high, added.centre + kRowMargin * added.holeAlong);
    }
    record.row1 = std::max(low, kLeastStrip);
    record.row3 = std::min(high, 1 - kLeastStrip);
    for (std::uint32_t i = 0; i < record.branchCount; ++i) {  // a hole that was denied its room shrinks
      shared::ForkBranch& branch = branches[record.firstBranch + i];
      const float most = (record.row3 - record.row1) / (2 * kRowMargin);
      branch.holeAlong = std::min(branch.holeAlong, most);
      // No clamp(): where the hole takes all there is, the least may be above the most by a rounding.
      const float least = record.row1 + kRowMargin * branch.holeAlong,
                  last = record.row3 - kRowMargin * branch.holeAlong;
      branch.centre = branch.centre < least ? least : std::min(branch.centre, last);
    }
  }
  record.row2 = (record.row1 + record.row3) / 2;
  return record;
}

}  // namespace vasa
