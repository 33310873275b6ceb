#include "network/builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <tuple>

namespace vasa {
namespace {

constexpr float kFarthest = 1000;  // [m] floats are 0.06 mm apart there

std::string place(const Vessel& vessel, std::uint32_t index) {
  return "vessel " + std::to_string(index) + (vessel.name.empty() ? "" : " '" + vessel.name + "'");
}

Result<void> checkPoints(std::span<const vec4> points, const std::string& where) {
  float length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vec4& p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w))
      return badInput(where + ": point " + std::to_string(i) + " is not finite");
    if (p.w <= 0)
      return badInput(where + ": point " + std::to_string(i) + ": radius " + std::to_string(p.w) +
                      " must be positive");
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kFarthest)
      return badInput(
          where + ": point " + std::to_string(i) +
          " lies more than 1 km from the origin, where numbers hold no tenths of a millimetre; move the "
          "vessels nearer to it, or give the file's unit");
    if (i) length += glm::distance(vec3(p), vec3(points[i - 1]));
  }
  if (!(length > 0)) return badInput(where + " has no length");
  return {};
}

// Depth-first order of nodes so that a node comes after every node that its host's shape hangs on.
class PinOrder {
 public:
  explicit PinOrder(const Network& network) : network_(network), state_(network.nodes().size(), 0) {}

  bool run(std::vector<NodeId>& order) {
    for (std::uint32_t i = 0; i < state_.size(); ++i)
      if (!visit(i, order)) return false;
    return true;
  }
  std::uint32_t fault = 0;

 private:
  // Iterative: a chain of side branches may be as long as a hostile file likes.
  bool visit(std::uint32_t first, std::vector<NodeId>& order) {
    struct Step {
      std::uint32_t node;
      int next;
    };
    if (state_[first] == 2) return true;
    std::vector<Step> stack{{first, 0}};
    state_[first] = 1;
    while (!stack.empty()) {
      Step& step = stack.back();
      const Node& node = network_.nodes()[step.node];
      if (!node.host || step.next == 2) {
        state_[step.node] = 2;
        order.push_back({step.node});
        stack.pop_back();
        continue;
      }
      const Vessel& host = network_.vessel(node.host->vessel);
      const NodeId needed = step.next++ == 0 ? host.start : host.end;
      if (!needed.valid() || state_[needed.value] == 2) continue;
      if (state_[needed.value] == 1) {
        fault = step.node;
        return false;
      }
      state_[needed.value] = 1;
      stack.push_back({needed.value, 0});
    }
    return true;
  }

  const Network& network_;
  std::vector<char> state_;
};

std::uint64_t keyOf(const Host& host) {
  return std::uint64_t(host.vessel.value) << 32 |
         std::bit_cast<std::uint32_t>(host.parameter + 0.0f);  // -0 as 0
}

Error crowded(const Network& network, std::uint32_t node, const std::string& where, VesselEnd last) {
  return badInput("node " + std::to_string(node) + ": more than " + std::to_string(kMostEndsAtNode) +
                  " vessels would meet " + where + ", among them " +
                  place(network.vessel(last.vessel), last.vessel.value) +
                  "; let them leave another vessel one after the other, or farther apart");
}

// Nodes on one host within its radius count together: their vessels are neighbours all the same.
Result<void> checkSides(const Network& network) {
  std::vector<std::uint32_t> onSides;
  for (std::uint32_t n = 0; n < network.nodes().size(); ++n)
    if (network.nodes()[n].host) onSides.push_back(n);
  const auto hostOf = [&](std::uint32_t n) { return *network.nodes()[n].host; };
  std::ranges::sort(onSides, {}, [&](std::uint32_t n) {
    return std::tuple(hostOf(n).vessel.value, hostOf(n).parameter, n);
  });
  struct Met {
    std::uint32_t node;
    float along;  // the host, from its first node
  };
  std::deque<Met> met;  // within a radius behind the place that is looked at
  std::size_t ends = 0;
  vec3 before{};
  for (const std::uint32_t n : onSides) {
    const VesselId host = hostOf(n).vessel;
    const vec4 at = evaluate(network.pointsOf(network.vessel(host)), hostOf(n).parameter);
    if (!met.empty() && hostOf(met.back().node).vessel != host) met.clear(), ends = 0;
    const float along = met.empty() ? 0 : met.back().along + glm::distance(vec3(at), before);
    before = vec3(at);
    met.push_back({n, along});
    ends += network.nodes()[n].endCount;
    for (; met.front().along < along - at.w; met.pop_front())
      ends -= network.nodes()[met.front().node].endCount;
    if (ends > kMostEndsAtNode)
      return crowded(network, n, "within a radius of " + place(network.vessel(host), host.value),
                     network.ends(network.nodes()[n]).back());
  }
  return {};
}

}  // namespace

VesselId NetworkBuilder::addVessel(Label label, std::vector<vec4> points) {
  labels_.push_back(std::move(label));
  points_.push_back(std::move(points));
  return {std::uint32_t(labels_.size() - 1)};
}

NodeId NetworkBuilder::addNode(std::optional<Host> host, std::vector<VesselEnd> ends) {
  const NodeId node{std::uint32_t(nodes_.size())};
  if (host) hosted_.try_emplace(keyOf(*host), node.value);
  nodes_.push_back({host, std::move(ends)});
  return node;
}

NodeId NetworkBuilder::joinEnds(std::vector<VesselEnd> ends) {
  return addNode(std::nullopt, std::move(ends));
}

NodeId NetworkBuilder::joinToSide(VesselEnd end, Host host) {
  const auto known = hosted_.find(keyOf(host));
  if (known == hosted_.end()) return addNode(host, {end});
  addEnd({known->second}, end);
  return {known->second};
}

void NetworkBuilder::addEnd(NodeId node, VesselEnd end) { nodes_[node.value].ends.push_back(end); }

Result<Network> NetworkBuilder::build(float bodyHeight) const {
  if (!(bodyHeight > 0) || !std::isfinite(bodyHeight)) return badInput("the body height must be positive");
  Network network;
  network.bodyHeight_ = bodyHeight;
  for (std::uint32_t i = 0; i < labels_.size(); ++i) {
    Vessel vessel{labels_[i].name,
                  labels_[i].ontologyId,
                  labels_[i].kind,
                  std::uint32_t(network.points_.size()),
                  std::uint32_t(points_[i].size()),
                  {},
                  {}};
    if (points_[i].size() < kMinPoints)
      return badInput(place(vessel, i) + " has " + std::to_string(points_[i].size()) +
                      " control points; a cubic needs at least 4");
    if (auto checked = checkPoints(points_[i], place(vessel, i)); !checked) return checked.error();
    network.points_.insert(network.points_.end(), points_[i].begin(), points_[i].end());
    network.vessels_.push_back(std::move(vessel));
  }
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const PendingNode& pending = nodes_[n];
    const std::string where = "node " + std::to_string(n);
    if (pending.ends.empty()) return badInput(where + " has no vessel end");
    if (!pending.host && pending.ends.size() < 2)
      return badInput(where + " joins nothing: it has one end only");
    if (pending.host) {
      const Host& host = *pending.host;
      if (host.vessel.value >= network.vessels_.size())
        return badInput(where + ": host vessel " + std::to_string(host.vessel.value) + " does not exist");
      const Vessel& vessel = network.vessel(host.vessel);
      if (!(host.parameter >= 0 && host.parameter <= float(vessel.spanCount())))
        return badInput(where + ": parameter " + std::to_string(host.parameter) + " lies outside " +
                        place(vessel, host.vessel.value));
    }
    for (const VesselEnd& end : pending.ends) {
      if (end.vessel.value >= network.vessels_.size())
        return badInput(where + ": vessel " + std::to_string(end.vessel.value) + " does not exist");
      Vessel& vessel = network.vessels_[end.vessel.value];
      if (pending.host && pending.host->vessel == end.vessel)
        return badInput(where + ": " + place(vessel, end.vessel.value) + " would hang on itself");
      NodeId& slot = end.last ? vessel.end : vessel.start;
      if (slot.valid())
        return badInput(where + ": the " + (end.last ? "last" : "first") + " point of " +
                        place(vessel, end.vessel.value) + " belongs to node " + std::to_string(slot.value) +
                        " already");
      slot = {n};
    }
    if (pending.ends.size() > kMostEndsAtNode)
      return crowded(network, n, "in one place", pending.ends.back());
    network.nodes_.push_back(
        {pending.host, std::uint32_t(network.ends_.size()), std::uint32_t(pending.ends.size())});
    network.ends_.insert(network.ends_.end(), pending.ends.begin(), pending.ends.end());
  }
  PinOrder order(network);
  if (!order.run(network.pinOrder_))
    return badInput("node " + std::to_string(order.fault) +
                    ": side branches hang on one another in a circle; split one of the vessels there");
  const std::vector<vec4> before = network.points_;
  pinEnds(network, network.points_);
  if (auto checked = checkSides(network); !checked) return checked.error();
  for (std::uint32_t i = 0; i < network.vessels_.size(); ++i) {
    const Vessel& vessel = network.vessels_[i];
    for (const std::uint32_t p : {vessel.firstPoint, vessel.firstPoint + vessel.pointCount - 1})
      if (glm::distance(vec3(before[p]), vec3(network.points_[p])) > 0.05f * bodyHeight)
        return badInput(place(vessel, i) + ": an end lies more than 5 % of the body height from its node");
    if (auto checked = checkPoints(network.pointsOf(vessel), place(vessel, i)); !checked)
      return checked.error();
  }
  return network;
}

}  // namespace vasa
