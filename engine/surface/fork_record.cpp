#include "surface/fork_record.h"

#include <algorithm>
#include <cmath>

#include "surface/sweep_table.h"

namespace vasa {
namespace {

constexpr int kSearchSteps = 256;
constexpr float kWindowMargin = 1.2f;  // columns stay outside the hole

struct SpanPlace {
  std::uint32_t point, spanClass, span;
  float t;
};

SpanPlace spanPlace(const Network& network, const VesselPlace& place) {
  const Vessel& vessel = network.vessels()[place.vessel];
  const auto [span, t] = locate(place.u, vessel.spanCount());
  return {vessel.firstPoint + span, spanClassOf(span, vessel.spanCount()), span, t};
}

shared::ForkRing ringAt(const Network& network, const VesselPlace& place, bool against) {
  const Vessel& vessel = network.vessels()[place.vessel];
  const SpanPlace at = spanPlace(network, place);
  return {at.point, firstKnot(network, {place.vessel}) + at.span, at.spanClass, vessel.firstPoint,
          vessel.firstPoint + vessel.pointCount - 1, at.t, place.reversed != against ? -1.0f : 1.0f};
}

// d/ds of the trunk from d/du of a ring's vessel.
float scaleAt(const Network& network, const VesselPlace& place, const ForkCourse& course) {
  if (course.low.vessel == course.high.vessel) return course.high.u - course.low.u;
  const vec3 speed(evaluateDerivative(network.pointsOf(network.vessels()[place.vessel]), place.u));
  return (place.reversed ? -1.0f : 1.0f) * course.length / std::max(glm::length(speed), 1e-9f);
}

}  // namespace

std::uint32_t spanClassOf(std::uint32_t span, std::uint32_t spans) {
  return 3 * std::min(span, 2u) + std::min(spans - 1 - span, 2u);
}

shared::ForkRecord makeForkRecord(const Network& network, const ForkCourse& course) {
  shared::ForkRecord record{};
  record.a = ringAt(network, course.low, false);
  record.b = ringAt(network, course.high, false);
  record.scaleA = scaleAt(network, course.low, course);
  record.scaleB = scaleAt(network, course.high, course);
  record.vesselA = course.low.vessel;
  record.vesselB = course.high.vessel;
  record.vesselBranch = course.low.vessel;
  record.row1 = 0.25f;
  record.centre = 0.5f;
  record.row3 = 0.75f;
  if (!course.branch) return record;
  const ForkCourse::Branch& branch = *course.branch;
  record.hasBranch = 1;
  record.branch = ringAt(network, branch.ring, branch.last);
  const SpanPlace cross = spanPlace(network, branch.cross);
  record.crossPoint = cross.point;
  record.crossClass = cross.spanClass;
  record.crossT = cross.t;
  record.vesselBranch = branch.ring.vessel;
  record.holeAround = branch.around;
  record.window = (kWindowMargin * std::asin(branch.around) + 0.02f) / kPi;
  const auto end = [&](const VesselPlace& place, float scale) {
    const auto points = network.pointsOf(network.vessels()[place.vessel]);
    return std::pair(evaluate(points, place.u), scale * evaluateDerivative(points, place.u));
  };
  const auto [a, ta] = end(course.low, record.scaleA);
  const auto [b, tb] = end(course.high, record.scaleB);
  const Bezier trunk{{a, a + ta / 3.0f, b - tb / 3.0f, b}};
  float nearest = 1e30f;
  for (int i = 0; i <= kSearchSteps; ++i) {
    const float s = float(i) / kSearchSteps, distance = glm::distance(vec3(trunk.at(s)), course.centre);
    if (distance < nearest) nearest = distance, record.centre = s;
  }
  record.centre = std::clamp(record.centre, 0.1f, 0.9f);
  const float along = branch.hole / std::max(glm::length(vec3(trunk.derivative(record.centre))), 1e-9f);
  record.row1 = std::max(record.centre - 1.2f * along, 0.15f * record.centre);
  record.row3 = std::min(record.centre + 1.2f * along, 1 - 0.15f * (1 - record.centre));
  record.holeAlong = std::min({along, 0.85f * (record.centre - record.row1), 0.85f * (record.row3 - record.centre)});
  return record;
}

}  // namespace vasa
