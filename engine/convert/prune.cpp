#include "convert/prune.h"

#include <algorithm>
#include <map>

namespace vasa {
namespace {

constexpr float kStub = 1.5f;  // radii of its parent that a stub reaches from the fork; a bump reaches one

// The radius of a chain where it leaves a node: the median of its first few contours.
float radiusAt(const AxisChain& chain, bool last) {
  std::vector<float> radii;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, chain.points.size()); ++i)
    radii.push_back(last ? chain.points[chain.points.size() - 1 - i].w : chain.points[i].w);
  if (radii.empty()) return 0;
  std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

// Contours where a level touches a bend are far too long, so a chain's thickness is a median.
float medianRadius(const AxisChain& chain) {
  std::vector<float> radii;
  for (const vec4& p : chain.points) radii.push_back(p.w);
  if (radii.empty()) return 0;
  const auto middle = radii.begin() + std::ptrdiff_t(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

// All of `chain` runs inside or close beside the other: strips of one torn tube.
bool shadowed(const AxisChain& chain, const AxisChain& other, float detail) {
  for (const vec4& p : chain.points) {
    bool near = false;
    for (const vec4& q : other.points)
      near = near || glm::distance(vec3(p), vec3(q)) < std::max(1.2f * std::max(p.w, q.w), detail);
    if (!near) return false;
  }
  return true;
}

void erase(AxisGraph& graph, std::uint32_t chain) { graph.chains.erase(graph.chains.begin() + chain); }

// How far a leaf reaches from its fork. A stub that is shorter than half its girth is nowhere a ring of its
// own when the front comes by way of a side branch: its chain is short, and its tip is far from the fork even
// so.
float reachOf(const AxisChain& chain, vec3 fork) {
  float farthest = 0;
  for (const vec4& p : chain.points) farthest = std::max(farthest, glm::distance(vec3(p), fork));
  return farthest;
}

// The shortest leaf chain below the radius of its parent, counted in those radii.
bool pruneOne(AxisGraph& graph, float detail, bool keepStubs) {
  const auto ends = chainEnds(graph);
  float worst = 1;
  std::int64_t chosen = -1;
  for (std::uint32_t i = 0; i < graph.chains.size(); ++i) {
    const AxisChain& chain = graph.chains[i];
    const bool startFree = ends[chain.start].size() == 1, endFree = ends[chain.end].size() == 1;
    if (startFree == endFree) continue;
    const auto& fork = ends[startFree ? chain.end : chain.start];
    if (fork.size() < 3) continue;
    float parent = 0;
    for (const ChainEnd& end : fork)
      if (end.chain != i) parent = std::max(parent, radiusAt(graph.chains[end.chain], end.last));
    const float thick = std::max({parent, detail, 1e-9f});
    float ratio = chain.length / thick;
    if (keepStubs)
      ratio =
          std::max(ratio, reachOf(chain, graph.nodes[startFree ? chain.end : chain.start]) / (kStub * thick));
    for (const ChainEnd& end : fork)
      if (end.chain != i && medianRadius(chain) <= medianRadius(graph.chains[end.chain]) && ratio >= 1 &&
          shadowed(chain, graph.chains[end.chain], detail))
        ratio = 0.999f;
    if (ratio < worst) worst = ratio, chosen = i;
  }
  if (chosen < 0) return false;
  erase(graph, std::uint32_t(chosen));
  compact(graph);
  return true;
}

// A chain that returns to its own node, or the thinner of two that join the same nodes, if both are short.
bool closeLoop(AxisGraph& graph, float detail) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> seen;
  const auto girth = [&](std::uint32_t i) {
    return std::max(2 * kPi * medianRadius(graph.chains[i]), 4 * detail);
  };
  for (std::uint32_t i = 0; i < graph.chains.size(); ++i) {
    const AxisChain& chain = graph.chains[i];
    if (chain.start == chain.end) {
      if (chain.length > girth(i) || graph.chains.size() == 1) continue;
      erase(graph, i);
      compact(graph);
      return true;
    }
    const auto [found, fresh] = seen.emplace(std::minmax({chain.start, chain.end}), i);
    if (fresh) continue;
    const std::uint32_t other = found->second;
    const bool small = chain.length + graph.chains[other].length <= std::max(girth(i), girth(other));
    if (!small && !shadowed(chain, graph.chains[other], detail) &&
        !shadowed(graph.chains[other], chain, detail))
      continue;
    erase(graph, medianRadius(graph.chains[i]) <= medianRadius(graph.chains[other]) ? i : other);
    compact(graph);
    return true;
  }
  return false;
}

// Forks nearer than the radius of what joins them. In a bend a front runs ahead along the inner side, so that
// its way from fork to fork on the outer side is shorter than they are apart.
bool mergeOne(AxisGraph& graph, float detail) {
  const auto valence = graph.valences();
  for (std::uint32_t i = 0; i < graph.chains.size(); ++i) {
    const AxisChain chain = graph.chains[i];
    if (chain.start == chain.end || valence[chain.start] < 3 || valence[chain.end] < 3) continue;
    const float apart =
        std::max(chain.length, glm::distance(graph.nodes[chain.start], graph.nodes[chain.end]));
    if (apart >= std::max({radiusAt(chain, false), radiusAt(chain, true), detail})) continue;
    graph.nodes[chain.start] = 0.5f * (graph.nodes[chain.start] + graph.nodes[chain.end]);
    erase(graph, i);
    for (AxisChain& other : graph.chains) {
      if (other.start == chain.end) other.start = chain.start;
      if (other.end == chain.end) other.end = chain.start;
    }
    compact(graph);
    return true;
  }
  return false;
}

}  // namespace

PruneReport prune(AxisGraph& graph, float detail, bool keepStubs) {
  PruneReport report;
  // Each step removes a chain, so this ends.
  for (bool changed = true; changed;) {
    changed = false;
    while (closeLoop(graph, detail)) ++report.loops, changed = true;
    while (pruneOne(graph, detail, keepStubs)) ++report.pruned, changed = true;
    while (mergeOne(graph, detail)) ++report.merged, changed = true;
  }
  return report;
}

}  // namespace vasa
