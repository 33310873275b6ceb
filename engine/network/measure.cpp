#include "network/measure.h"

namespace vasa {
namespace {

bool folds(const Bezier& tube) {
  constexpr int kSamples = 8;
  for (int k = 0; k <= kSamples; ++k) {
    const float t = float(k) / kSamples;
    const vec3 first(tube.derivative(t)), second(tube.secondDerivative(t));
    const float speed = glm::length(first);
    if (tube.at(t).w * glm::length(glm::cross(first, second)) >= speed * speed * speed) return true;
  }
  return false;
}

}  // namespace

NetworkMeasures measure(const Network& network, std::span<const vec4> points) {
  NetworkMeasures sum;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    sum.arteries += vessel.kind == VesselKind::artery;
    sum.veins += vessel.kind == VesselKind::vein || vessel.kind == VesselKind::portalVein;
    sum.length += lengthOf(own);
    sum.volume += volumeOf(own);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) sum.bounds.add(bezierOfSpan(own, span).bounds());
  }
  return sum;
}

std::uint32_t kinkCount(const Network& network, std::span<const vec4> points) {
  std::uint32_t count = 0;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) count += folds(bezierOfSpan(own, span));
  }
  return count;
}

}  // namespace vasa
