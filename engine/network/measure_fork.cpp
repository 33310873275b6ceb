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

float parameterOf(const Network& network, const VesselEnd& end) {
  return network.vessel(end.vessel).parameterOf(end.last);
}

// The vessel that comes to a fork, and where on it the fork is.
struct Trunk {
  VesselId vessel;
  float parameter;
  std::optional<VesselEnd> end;  // none: the fork is on its side
};

// None where fewer than three arms meet.
std::optional<Trunk> trunkOf(const Network& network, std::span<const vec4> points, const Node& node) {
  if (node.valence() < 3) return std::nullopt;
  if (node.host) return Trunk{node.host->vessel, node.host->parameter, std::nullopt};
  // Files run from a trunk to its branches: of the vessels that end here the widest, or of all.
  const auto ends = network.ends(node);
  const bool anyLast = std::ranges::any_of(ends, &VesselEnd::last);
  std::optional<VesselEnd> widest;
  float most = 0;
  for (const VesselEnd& end : ends) {
    if (anyLast && !end.last) continue;
    const float radius =
        evaluate(Network::pointsOf(network.vessel(end.vessel), points), parameterOf(network, end)).w;
    if (widest && !(radius > most)) continue;
    widest = end;
    most = radius;
  }
  return Trunk{widest->vessel, parameterOf(network, *widest), widest};
}

ForkMeasures forkAt(const Network& network, std::span<const vec4> points, const Node& node, const Trunk& at) {
  const auto pointsOf = [&](VesselId vessel) { return Network::pointsOf(network.vessel(vessel), points); };
  const float way = 2 * evaluate(pointsOf(at.vessel), at.parameter).w;
  const bool backwards = !at.end || at.end->last;
  const View trunk = viewFrom(pointsOf(at.vessel), at.parameter, !backwards, way);
  ForkMeasures fork;
  fork.node = {std::uint32_t(&node - network.nodes().data())};
  fork.trunk = at.vessel;
  fork.trunkParameter = at.parameter;
  fork.trunkRadius = trunk.radius;
  const auto add = [&](VesselId vessel, float parameter, bool last, bool host) {
    const View arm = viewFrom(pointsOf(vessel), parameter, !last, way);
    fork.arms.push_back({vessel, last, host, arm.radius,
                         std::acos(std::clamp(glm::dot(arm.course, -trunk.course), -1.0f, 1.0f))});
  };
  if (!at.end && at.parameter < float(network.vessel(at.vessel).spanCount()))
    add(at.vessel, at.parameter, false, true);
  for (const VesselEnd& end : network.ends(node))
    if (end != at.end) add(end.vessel, parameterOf(network, end), end.last, false);
  std::vector<float> radii;
  for (const ForkArm& arm : fork.arms) radii.push_back(arm.radius);
  fork.murray = murrayExponent(fork.trunkRadius, radii);
  return fork;
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

std::vector<ForkMeasures> measureForks(const Network& network, std::span<const vec4> points,
                                       std::optional<VesselId> trunk) {
  std::vector<ForkMeasures> all;
  for (const Node& node : network.nodes())
    if (const auto at = trunkOf(network, points, node); at && (!trunk || at->vessel == *trunk))
      all.push_back(forkAt(network, points, node, *at));
  return all;
}

}  // namespace vasa
