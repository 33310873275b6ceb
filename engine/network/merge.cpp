#include "network/merge.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "network/builder.h"

namespace vasa {

Result<Network> mergeNetworks(std::span<const Network> networks) {
  if (networks.empty()) return badInput("there is no network to merge; name at least one");
  NetworkBuilder builder;
  std::vector<ForkPatch> patches;
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
    for (ForkPatch patch : network.patches()) {
      for (PatchRing& ring : patch.rings) ring.vessel.value += base;
      patches.push_back(std::move(patch));
    }
  }
  auto merged = builder.build(networks.front().bodyHeight());
  if (!merged || patches.empty()) return merged;
  return withPatches(std::move(*merged), std::move(patches));
}

std::size_t sharedVessels(const Network& a, const Network& b) {
  std::multimap<std::string_view, const Vessel*> called;
  for (const Vessel& vessel : b.vessels()) called.emplace(vessel.name, &vessel);
  const auto meet = [](vec4 p, vec4 q) { return glm::distance(vec3(p), vec3(q)) < 0.1f * p.w; };
  return std::size_t(std::ranges::count_if(a.vessels(), [&](const Vessel& vessel) {
    const auto own = a.pointsOf(vessel);
    const auto [first, last] = called.equal_range(vessel.name);
    return std::any_of(first, last, [&](const auto& entry) {
      const auto other = b.pointsOf(*entry.second);
      return meet(own.front(), other.front()) && meet(own.back(), other.back());
    });
  }));
}

}  // namespace vasa
