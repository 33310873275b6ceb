#include "network/route.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace vasa {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

float speed(const Bezier& segment, float t) { return glm::length(vec3(segment.derivative(t))); }

// [m] of a segment from its start to t, by Simpson's rule on eight parts.
float lengthTo(const Bezier& segment, float t) {
  constexpr int kParts = 8;
  const float step = t / kParts;
  float sum = speed(segment, 0) + speed(segment, t);
  for (int k = 1; k < kParts; ++k) sum += (k % 2 ? 4.0f : 2.0f) * speed(segment, step * float(k));
  return sum * step / 3;
}

void addOnce(std::vector<VesselId>& list, VesselId vessel) {
  if (std::ranges::find(list, vessel) == list.end()) list.push_back(vessel);
}

}  // namespace

Relatives relativesOf(const Network& network, VesselId id) {
  Relatives relatives;
  const Vessel& vessel = network.vessel(id);
  for (const bool last : {false, true}) {
    const NodeId at = vessel.node(last);
    if (!at.valid()) continue;
    const Node& node = network.node(at);
    if (node.host) addOnce(relatives.parents, node.host->vessel);
    for (const VesselEnd& end : network.ends(node)) {
      if (end.vessel == id || node.host) continue;
      // Blood's way is not known; files run from a trunk to its branches.
      if (!last && end.last) addOnce(relatives.parents, end.vessel);
      if (last && !end.last) addOnce(relatives.children, end.vessel);
    }
  }
  for (const Node& node : network.nodes())
    if (node.host && node.host->vessel == id)
      for (const VesselEnd& end : network.ends(node)) addOnce(relatives.children, end.vessel);
  return relatives;
}

std::vector<VesselId> treeBelow(const Network& network, VesselId vessel) {
  std::vector<VesselId> tree{vessel};
  std::vector<char> met(network.vessels().size(), 0);
  met[vessel.value] = 1;
  for (std::size_t i = 0; i < tree.size(); ++i)
    for (const VesselId child : relativesOf(network, tree[i]).children)
      if (!std::exchange(met[child.value], 1)) tree.push_back(child);
  return tree;
}

RouteFinder::RouteFinder(const Network& network, std::span<const vec4> points)
    : network_(&network), points_(points.begin(), points.end()), lines_(network.vessels().size()) {
  for (std::size_t v = 0; v < lines_.size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const auto own = Network::pointsOf(vessel, points_);
    lines_[v].lengths.assign(1, 0);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      lines_[v].lengths.push_back(lines_[v].lengths.back() + lengthTo(bezierOfSpan(own, span), 1));
  }
  const auto stop = [&](VesselId vessel, float parameter, std::uint32_t node) {
    lines_[vessel.value].stops.push_back({parameter, along({vessel, parameter}), node});
  };
  for (std::uint32_t n = 0; n < network.nodes().size(); ++n) {
    const Node& node = network.nodes()[n];
    if (node.host) stop(node.host->vessel, node.host->parameter, n);
    for (const VesselEnd& end : network.ends(node))
      stop(end.vessel, network.vessel(end.vessel).parameterOf(end.last), n);
  }
  for (Line& line : lines_) std::ranges::stable_sort(line.stops, {}, &Stop::parameter);
}

float RouteFinder::along(VesselPlace place) const {
  const Vessel& vessel = network_->vessel(place.vessel);
  const auto [span, t] = locate(place.parameter, vessel.spanCount());
  return lines_[place.vessel.value].lengths[span] +
         lengthTo(bezierOfSpan(Network::pointsOf(vessel, points_), span), t);
}

std::optional<Route> RouteFinder::find(VesselPlace from, VesselPlace to) const {
  const std::size_t nodes = network_->nodes().size();
  // How each node is reached: from which node (or none: from the start), along which vessel.
  struct Way {
    float length = kFar;
    std::uint32_t before = NodeId::kNone;
    Route::Leg leg;
  };
  std::vector<Way> ways(nodes + 1);  // the last: the goal
  const std::uint32_t goal = std::uint32_t(nodes);
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t at, float length, std::uint32_t before, Route::Leg leg) {
    if (length >= ways[at].length) return;
    ways[at] = {length, before, leg};
    queue.push({length, at});
  };
  const auto leave = [&](VesselId vessel, float parameter, float base, std::uint32_t before) {
    const float here = along({vessel, parameter});
    for (const Stop& stop : lines_[vessel.value].stops)
      if (stop.node != before)
        reach(stop.node, base + std::abs(stop.along - here), before, {vessel, parameter, stop.parameter});
    if (vessel == to.vessel)
      reach(goal, base + std::abs(along(to) - here), before, {vessel, parameter, to.parameter});
  };
  leave(from.vessel, from.parameter, 0, NodeId::kNone);
  while (!queue.empty()) {
    const auto [length, at] = queue.top();
    queue.pop();
    if (length > ways[at].length) continue;
    if (at == goal) break;
    const Node& node = network_->nodes()[at];
    if (node.host) leave(node.host->vessel, node.host->parameter, length, at);
    for (const VesselEnd& end : network_->ends(node))
      leave(end.vessel, network_->vessel(end.vessel).parameterOf(end.last), length, at);
  }
  if (ways[goal].length == kFar) return std::nullopt;
  Route route{{}, ways[goal].length};
  for (std::uint32_t at = goal; at != NodeId::kNone; at = ways[at].before) route.legs.push_back(ways[at].leg);
  std::ranges::reverse(route.legs);
  return route;
}

}  // namespace vasa
