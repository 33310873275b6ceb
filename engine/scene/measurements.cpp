#include "scene/measurements.h"

#include <algorithm>
#include <limits>

namespace vasa {

VesselMeasures measureVessel(std::span<const vec4> points) {
  constexpr int kPerSpan = 8;
  VesselMeasures out;
  out.length = lengthOf(points);
  out.volume = volumeOf(points);
  out.leastRadius = std::numeric_limits<float>::max();
  double sum = 0, weight = 0;
  for (std::uint32_t span = 0; span < spanCount(points); ++span) {
    const Bezier segment = bezierOfSpan(points, span);
    for (int k = 0; k <= kPerSpan; ++k) {
      const float t = float(k) / kPerSpan, radius = segment.at(t).w;
      const float speed = glm::length(vec3(segment.derivative(t)));
      out.leastRadius = std::min(out.leastRadius, radius);
      out.greatestRadius = std::max(out.greatestRadius, radius);
      sum += double(speed * radius), weight += double(speed);
      out.greatestCurvature = std::max(out.greatestCurvature, segment.curvature(t));
    }
  }
  out.meanRadius = weight > 0 ? float(sum / weight) : out.leastRadius;
  return out;
}

VesselMeter::VesselMeter(const Network& network, float within)
    : network_(&network), within_(within), interference_(network) {}

std::vector<VesselMeasures> VesselMeter::run(std::span<const vec4> points) {
  std::vector<VesselMeasures> all;
  for (const Vessel& vessel : network_->vessels())
    all.push_back(measureVessel(Network::pointsOf(vessel, points)));
  const auto touch = [&](std::uint32_t tube, float gap) {
    auto& clearance = all[interference_.layout().address(tube).vessel.value].clearance;
    clearance = std::min(clearance.value_or(gap), gap);
  };
  for (const auto& place : interference_.find(points, within_)) {
    const auto vesselOf = [&](std::uint32_t tube) { return interference_.layout().address(tube).vessel; };
    if (vesselOf(place.contact.i) == vesselOf(place.contact.j)) continue;
    touch(place.contact.i, place.contact.f);
    touch(place.contact.j, place.contact.f);
  }
  return all;
}

}  // namespace vasa
