#include "network/measure_profile.h"

#include <algorithm>
#include <cmath>

#include "curve/arc_length.h"
#include "curve/frame.h"

namespace vasa {

namespace {

// From one place of a vessel to another, `along` being counted on from `before`.
void addStations(std::span<const vec4> points, float from, float to, float step, float before,
                 std::vector<ProfileStation>& stations) {
  constexpr float kMost = 1e6f;  // stations
  const ArcLength arc(points);
  const float first = arc.along(from), last = arc.along(to);
  if (first == last && !stations.empty()) return;  // the way ends where it came in
  const auto count = std::uint32_t(std::clamp(std::ceil(std::abs(last - first) / step), 1.0f, kMost));
  for (std::uint32_t i = 0; i <= count; ++i) {
    ProfileStation station;
    const float along = first + (last - first) * float(i) / float(count);
    station.along = before + std::abs(along - first);
    station.parameter = i == 0 ? from : i == count ? to : arc.parameterAt(along);
    const auto [span, t] = locate(station.parameter, spanCount(points));
    const Bezier segment = bezierOfSpan(points, span);
    const vec4 at = segment.at(t);
    station.centre = vec3(at), station.radius = at.w;
    station.tangent = unitTangent(points, station.parameter);
    station.curvature = segment.curvature(t);
    stations.push_back(station);
  }
}

}  // namespace

std::vector<ProfileStation> stationsOf(std::span<const vec4> points, float step) {
  std::vector<ProfileStation> stations;
  addStations(points, 0, float(spanCount(points)), step, 0, stations);
  return stations;
}

std::vector<ProfileStation> stationsAlong(const Network& network, std::span<const vec4> points,
                                          const Route& route, float step) {
  std::vector<ProfileStation> stations;
  for (const auto& [vessel, from, to] : route.legs)
    addStations(Network::pointsOf(network.vessel(vessel), points), from, to, step,
                stations.empty() ? 0 : stations.back().along, stations);
  return stations;
}

}  // namespace vasa
