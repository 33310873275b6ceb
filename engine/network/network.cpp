#include "network/network.h"

#include <algorithm>

#include "core/disjoint_sets.h"

namespace vasa {

std::string_view kindName(VesselKind kind) {
  constexpr std::string_view kNames[] = {"artery", "vein", "portal vein", "lymphatic", "other"};
  return kNames[int(kind)];
}

std::uint32_t Network::sweepCount() const {
  std::uint32_t count = 0;
  for (const Vessel& vessel : vessels_) count += vessel.spanCount();
  return count;
}

std::uint32_t Network::sectionCount() const { return sweepCount() + std::uint32_t(vessels_.size()); }

std::uint32_t Network::junctionCount() const {
  std::uint32_t count = 0;
  for (const Node& node : nodes_) count += node.valence() >= 3;
  return count;
}

std::vector<std::uint32_t> Network::components() const {
  DisjointSets parts(vessels_.size());
  for (const Node& node : nodes_) {
    const std::uint32_t first = node.host ? node.host->vessel.value : ends(node)[0].vessel.value;
    for (const VesselEnd& end : ends(node)) parts.unite(first, end.vessel.value);
  }
  std::vector<std::uint32_t> number(vessels_.size());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::uint32_t least = parts.find(v);
    number[v] = least == v ? next++ : number[least];
  }
  return number;
}

std::uint32_t Network::componentCount() const {
  std::uint32_t count = 0;
  for (const std::uint32_t number : components()) count = std::max(count, number + 1);
  return count;
}

void pinEnds(const Network& network, std::span<vec4> points) {
  for (const NodeId id : network.pinOrder()) {
    const Node& node = network.node(id);
    const auto ends = network.ends(node);
    const vec3 position = node.host
                              ? vec3(evaluate(Network::pointsOf(network.vessel(node.host->vessel), points),
                                              node.host->parameter))
                              : vec3(points[network.pointOf(ends[0])]);
    for (const VesselEnd& end : ends) {
      vec4& point = points[network.pointOf(end)];
      point = vec4(position, point.w);
    }
  }
}

}  // namespace vasa
