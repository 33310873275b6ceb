#include "network/merge.h"

#include "network/builder.h"

namespace vasa {

Result<Network> mergeNetworks(std::span<const Network> networks) {
  if (networks.empty()) return badInput("there is no network to merge; name at least one");
  NetworkBuilder builder;
  for (const Network& network : networks) {
    const auto base = std::uint32_t(builder.vesselCount());
    for (const Vessel& vessel : network.vessels()) {
      const auto points = network.pointsOf(vessel);
      builder.addVessel({vessel.name, vessel.ontologyId, vessel.kind}, {points.begin(), points.end()});
    }
    for (const Node& node : network.nodes()) {
      std::optional<Host> host = node.host;
      if (host) host->vessel.value += base;
      std::vector<VesselEnd> ends;
      for (VesselEnd end : network.ends(node)) {
        end.vessel.value += base;
        ends.push_back(end);
      }
      builder.addNode(host, std::move(ends));
    }
  }
  return builder.build(networks.front().bodyHeight());
}

}  // namespace vasa
