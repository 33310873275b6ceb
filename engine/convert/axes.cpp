#include "convert/axes.h"

#include <algorithm>

namespace vasa {

std::vector<std::uint32_t> AxisGraph::valences() const {
  std::vector<std::uint32_t> valence(nodes.size(), 0);
  for (const AxisChain& chain : chains) ++valence[chain.start], ++valence[chain.end];
  return valence;
}

std::vector<std::vector<ChainEnd>> chainEnds(const AxisGraph& graph) {
  std::vector<std::vector<ChainEnd>> ends(graph.nodes.size());
  for (std::uint32_t i = 0; i < graph.chains.size(); ++i) {
    ends[graph.chains[i].start].push_back({i, false});
    ends[graph.chains[i].end].push_back({i, true});
  }
  return ends;
}

namespace {

void turn(AxisChain& chain) {
  std::swap(chain.start, chain.end);
  std::reverse(chain.points.begin(), chain.points.end());
}

}  // namespace

void compact(AxisGraph& graph) {
  std::vector<bool> gone(graph.chains.size(), false);
  auto ends = chainEnds(graph);
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    if (ends[node].size() != 2 || ends[node][0].chain == ends[node][1].chain) continue;
    const auto [keep, drop] = std::minmax({ends[node][0].chain, ends[node][1].chain});
    AxisChain& a = graph.chains[keep];
    AxisChain& b = graph.chains[drop];
    if (a.end != node) turn(a);
    if (b.start != node) turn(b);
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    a.length += b.length;
    a.end = b.end;
    gone[drop] = true;
    for (ChainEnd& end : ends[a.end])
      if (end.chain == drop) end = {keep, true};
    for (ChainEnd& end : ends[a.start])
      if (end.chain == keep && a.start != a.end) end.last = false;
    ends[node].clear();
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < graph.chains.size(); ++i)
    if (!gone[i]) {
      if (kept != i) graph.chains[kept] = std::move(graph.chains[i]);
      ++kept;
    }
  graph.chains.resize(kept);

  const auto valence = graph.valences();
  std::vector<std::uint32_t> number(graph.nodes.size());
  std::vector<vec3> nodes;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    number[i] = std::uint32_t(nodes.size());
    if (valence[i] > 0) nodes.push_back(graph.nodes[i]);
  }
  graph.nodes = std::move(nodes);
  for (AxisChain& chain : graph.chains) chain.start = number[chain.start], chain.end = number[chain.end];
}

float polylineLength(const std::vector<vec4>& points) {
  float length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += glm::distance(vec3(points[i]), vec3(points[i - 1]));
  return length;
}

}  // namespace vasa
