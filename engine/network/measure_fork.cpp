#include "network/measure_fork.h"

#include <algorithm>
#include <cmath>

#include "curve/arc_length.h"
#include "curve/frame.h"

namespace vasa {
namespace {

// A vessel seen from one of its places, in one direction.
struct View {
  float radius;
  vec3 course;  // unit, away from the place
};

View viewFrom(std::span<const vec4> points, float parameter, bool forwards, float way) {
  const ArcLength arc(points);
  const float here = arc.along(parameter), rest = forwards ? arc.length() - here : here;
  const float off = std::min(way, 0.5f * rest);
  const float u = arc.parameterAt(forwards ? here + off : here - off);
  const vec3 tangent = unitTangent(points, u);
  return {evaluate(points, u).w, forwards ? tangent : -tangent};
}

}  // namespace

std::optional<float> murrayExponent(float trunk, std::span<const float> arms) {
  // Below 1 each, the arms' shares fall as the exponent grows.
  if (arms.empty() || !(trunk > 0)) return std::nullopt;
  const auto excess = [&](float x) {
    float sum = 0;
    for (const float arm : arms) sum += std::pow(arm / trunk, x);
    return sum - 1;
  };
  float low = 0.5f, high = 20;
  if (std::ranges::any_of(arms, [&](float arm) { return !(arm < trunk); }) || excess(low) < 0 ||
      excess(high) > 0)
    return std::nullopt;
  while (high - low > 1e-3f) (excess(0.5f * (low + high)) > 0 ? low : high) = 0.5f * (low + high);
  return 0.5f * (low + high);
}

std::vector<ForkMeasures> measureForks(const Network& network, std::span<const vec4> points) {
  std::vector<ForkMeasures> all;
  for (std::uint32_t n = 0; n < network.nodes().size(); ++n) {
    const Node& node = network.nodes()[n];
    if (node.valence() < 3) continue;
    const auto ends = network.ends(node);
    const auto pointsOf = [&](VesselId vessel) { return Network::pointsOf(network.vessel(vessel), points); };
    const auto parameterOf = [&](const VesselEnd& end) {
      return end.last ? float(network.vessel(end.vessel).spanCount()) : 0.0f;
    };
    const auto endRadius = [&](const VesselEnd& end) {
      return evaluate(pointsOf(end.vessel), parameterOf(end)).w;
    };
    ForkMeasures fork;
    fork.node = {n};
    std::optional<VesselEnd> trunkEnd;
    if (node.host) {
      fork.trunk = node.host->vessel, fork.trunkParameter = node.host->parameter;
    } else {
      // Files run from a trunk to its branches: of the vessels that end here the widest, or of all.
      const bool anyLast = std::ranges::any_of(ends, &VesselEnd::last);
      for (const VesselEnd& end : ends)
        if ((end.last || !anyLast) && (!trunkEnd || endRadius(end) > endRadius(*trunkEnd))) trunkEnd = end;
      fork.trunk = trunkEnd->vessel, fork.trunkParameter = parameterOf(*trunkEnd);
    }
    const float way = 2 * evaluate(pointsOf(fork.trunk), fork.trunkParameter).w;
    const bool trunkBackwards = node.host || trunkEnd->last;
    const View trunk = viewFrom(pointsOf(fork.trunk), fork.trunkParameter, !trunkBackwards, way);
    fork.trunkRadius = trunk.radius;
    const auto add = [&](VesselId vessel, float parameter, bool last, bool host) {
      const View arm = viewFrom(pointsOf(vessel), parameter, !last, way);
      fork.arms.push_back({vessel, last, host, arm.radius,
                           std::acos(std::clamp(glm::dot(arm.course, -trunk.course), -1.0f, 1.0f))});
    };
    if (node.host && node.host->parameter < float(network.vessel(fork.trunk).spanCount()))
      add(fork.trunk, fork.trunkParameter, false, true);
    for (const VesselEnd& end : ends)
      if (!trunkEnd || end != *trunkEnd) add(end.vessel, parameterOf(end), end.last, false);
    std::vector<float> radii;
    for (const ForkArm& arm : fork.arms) radii.push_back(arm.radius);
    fork.murray = murrayExponent(fork.trunkRadius, radii);
    all.push_back(std::move(fork));
  }
  return all;
}

}  // namespace vasa
