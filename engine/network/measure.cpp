#include "network/measure.h"

namespace vasa {
NetworkMeasures measure(const Network& network, std::span<const vec4> points) {
  NetworkMeasures sum;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    sum.arteries += vessel.kind == VesselKind::artery;
    sum.veins += vessel.kind == VesselKind::vein || vessel.kind == VesselKind::portalVein;
    sum.length += lengthOf(own);
    sum.volume += volumeOf(own);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      sum.bounds.add(bezierOfSpan(own, span).bounds());
  }
  return sum;
}

}  // namespace vasa
