#include "network/network.h"

#include <numeric>

namespace vasa {

std::string_view kindName(VesselKind kind) {
  switch (kind) {
    case VesselKind::artery:
      return "artery";
    case VesselKind::vein:
      return "vein";
    case VesselKind::portalVein:
      return "portal vein";
    case VesselKind::lymphatic:
      return "lymphatic";
    case VesselKind::other:
      break;
  }
  return "other";
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
  std::vector<std::uint32_t> parent(vessels_.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Node& node : nodes_) {
    const std::uint32_t first = node.host ? node.host->vessel.value : ends(node)[0].vessel.value;
    for (const VesselEnd& end : ends(node)) {
      const std::uint32_t a = root(first), b = root(end.vessel.value);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::uint32_t> number(vessels_.size());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) number[v] = root(v) == v ? next++ : number[root(v)];
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
