#include "network/network_key.h"

#include <array>

#include "core/hash.h"
#include "network/network.h"

namespace vasa {
namespace {

std::uint64_t hashedPatch(const ForkPatch& patch, std::uint64_t hash) {
  for (const PatchRing& ring : patch.rings) {
    hash = hashed(std::array{ring.vessel.value, ring.vertices}, hash);
    hash = hashed(std::array{ring.parameter, ring.radius}, hashed(ring.outward, hashed(ring.centre, hash)));
  }
  return hashedAll(patch.triangles, hashedAll(patch.weights, hashedAll(patch.positions, hash)));
}

}  // namespace

std::uint64_t networkKey(const Network& network) {
  std::uint64_t hash = hashOf(network.points());
  hash = hashed(network.bodyHeight(), hash);
  for (const Vessel& vessel : network.vessels())
    hash = hashed(std::array{std::uint32_t(vessel.kind), vessel.firstPoint, vessel.pointCount,
                             std::uint32_t(vessel.start.value), std::uint32_t(vessel.end.value)},
                  hash);
  for (const Node& node : network.nodes()) {
    if (node.host) hash = hashed(node.host->parameter, hashed(node.host->vessel.value, hash));
    for (const VesselEnd& end : network.ends(node))
      hash = hashed(std::array{std::uint32_t(end.vessel.value), std::uint32_t(end.last)}, hash);
    hash = hashed(std::array{node.firstEnd, node.endCount}, hash);
  }
  for (const ForkPatch& patch : network.patches()) hash = hashedPatch(patch, hash);
  return hash;
}

}  // namespace vasa
