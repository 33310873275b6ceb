#include "network/reshape.h"

#include "network/builder.h"

namespace vasa {

Result<Network> reshapeNetwork(const Network& network, std::span<const vec4> points, float bodyHeight) {
  NetworkBuilder builder;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    builder.addVessel({vessel.name, vessel.ontologyId, vessel.kind}, {own.begin(), own.end()});
  }
  for (const Node& node : network.nodes()) {
    const auto ends = network.ends(node);
    builder.addNode(node.host, {ends.begin(), ends.end()});
  }
  auto reshaped = builder.build(bodyHeight);
  if (!reshaped || network.patches().empty()) return reshaped;
  return withPatches(std::move(*reshaped), {network.patches().begin(), network.patches().end()});
}

}  // namespace vasa
