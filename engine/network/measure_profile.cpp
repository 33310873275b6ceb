#include "network/measure_profile.h"

#include <algorithm>
#include <cmath>

#include "curve/arc_length.h"
#include "curve/frame.h"

namespace vasa {

std::vector<ProfileStation> stationsOf(std::span<const vec4> points, float step) {
  constexpr float kMost = 1e6f;  // stations
  const ArcLength arc(points);
  const auto count = std::uint32_t(std::clamp(std::ceil(arc.length() / step), 1.0f, kMost));
  std::vector<ProfileStation> stations;
  for (std::uint32_t i = 0; i <= count; ++i) {
    ProfileStation station;
    station.along = arc.length() * float(i) / float(count);
    station.parameter = i == count ? float(spanCount(points)) : arc.parameterAt(station.along);
    const auto [span, t] = locate(station.parameter, spanCount(points));
    const Bezier segment = bezierOfSpan(points, span);
    const vec4 at = segment.at(t);
    station.centre = vec3(at), station.radius = at.w;
    station.tangent = unitTangent(points, station.parameter);
    const vec3 first(segment.derivative(t)), second(segment.secondDerivative(t));
    const float speed = glm::length(first);
    if (speed > 1e-9f) station.curvature = glm::length(glm::cross(first, second)) / (speed * speed * speed);
    stations.push_back(station);
  }
  return stations;
}

}  // namespace vasa
