#include "convert/strokes.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/ids.h"

namespace vasa {
namespace {

// Two branches continue one another when their outward directions are this far from parallel at most.
constexpr float kLeastStraight = 0.0f;
constexpr float kRadiusWeight = 0.5f;

// One end of a branch: 2 * branch + (1 at its last section).
using Tip = std::uint32_t;
Tip otherTip(Tip tip) { return tip ^ 1u; }

class Strokes {
 public:
  explicit Strokes(const ElementSkeleton& skeleton)
      : skeleton_(skeleton), next_(2 * skeleton.branches.size(), kNone) {
    at_.resize(skeleton.nodes.size());
    for (Tip tip = 0; tip < next_.size(); ++tip) at_[nodeOf(tip)].push_back(tip);
    for (std::uint32_t node = 0; node < at_.size(); ++node) pairAt(node);
    while (openOneLoop()) {
    }
  }

  // Chains of tips: each even entry enters a branch, the following one leaves it.
  std::vector<std::vector<Tip>> chains() const {
    std::vector<std::vector<Tip>> result;
    for (Tip tip = 0; tip < next_.size(); ++tip)
      if (next_[tip] == kNone) {
        std::vector<Tip> chain = walk(tip);
        if (chain.front() <= chain.back()) result.push_back(std::move(chain));
      }
    return result;
  }
  std::uint32_t nodeOf(Tip tip) const {
    const ElementBranch& branch = skeleton_.branches[tip / 2];
    return tip % 2 ? branch.endNode : branch.startNode;
  }

 private:
  const Sections& sectionsOf(Tip tip) const { return skeleton_.branches[tip / 2].sections; }
  float radiusNear(Tip tip) const { return endRadius(sectionsOf(tip), tip % 2); }
  float continuity(Tip a, Tip b) const {
    const float straight =
        -glm::dot(outwardDirection(sectionsOf(a), a % 2), outwardDirection(sectionsOf(b), b % 2));
    const float ra = radiusNear(a), rb = radiusNear(b);
    if (straight < kLeastStraight) return -1;
    return straight + kRadiusWeight * std::min(ra, rb) / std::max(ra, rb);
  }
  void link(Tip a, Tip b) { next_[a] = b, next_[b] = a; }
  void unlinkAt(std::uint32_t node) {
    for (const Tip tip : at_[node]) next_[tip] = kNone;
  }
  void pairAt(std::uint32_t node) {
    const std::vector<Tip>& tips = at_[node];
    if (tips.size() == 2 && tips[0] != otherTip(tips[1])) return link(tips[0], tips[1]);
    float best = 0;
    std::pair<Tip, Tip> pair{kNone, kNone};
    for (std::size_t i = 0; i < tips.size(); ++i)
      for (std::size_t j = i + 1; j < tips.size(); ++j) {
        if (tips[i] == otherTip(tips[j])) continue;
        if (const float value = continuity(tips[i], tips[j]); value > best)
          best = value, pair = {tips[i], tips[j]};
      }
    if (pair.first != kNone) link(pair.first, pair.second);
  }
  std::vector<Tip> walk(Tip from) const {
    std::vector<Tip> chain{from, otherTip(from)};
    while (next_[chain.back()] != kNone && next_[chain.back()] != from) {
      const Tip entry = next_[chain.back()];
      chain.push_back(entry);
      chain.push_back(otherTip(entry));
    }
    return chain;
  }
  // A stroke that closes on itself, passes a node twice or ends at a node it passes is cut there.
  bool openOneLoop() {
    std::vector<char> seen(next_.size(), 0);
    for (const bool closedOnes : {false, true})
      for (Tip tip = 0; tip < next_.size(); ++tip) {
        if (seen[tip] || (!closedOnes && next_[tip] != kNone)) continue;
        const std::vector<Tip> chain = walk(tip);
        for (const Tip member : chain) seen[member] = 1;
        if (closedOnes) return unlinkAt(nodeOf(chain.front())), true;
        std::set<std::uint32_t> passed;
        for (std::size_t i = 1; i + 1 < chain.size(); i += 2)
          if (!passed.insert(nodeOf(chain[i])).second) return unlinkAt(nodeOf(chain[i])), true;
        for (const Tip end : {chain.front(), chain.back()})
          if (passed.contains(nodeOf(end))) return unlinkAt(nodeOf(end)), true;
      }
    return false;
  }

  const ElementSkeleton& skeleton_;
  std::vector<Tip> next_;  // the tip that continues this one
  std::vector<std::vector<Tip>> at_;
};

Sections sectionsAlong(const ElementSkeleton& skeleton, std::span<const Tip> chain) {
  Sections all;
  for (std::size_t i = 0; i < chain.size(); i += 2) {
    Sections own = skeleton.branches[chain[i] / 2].sections;
    if (chain[i] % 2) std::ranges::reverse(own);
    for (const vec4& section : own)
      if (all.empty() || glm::distance(vec3(all.back()), vec3(section)) > 0) all.push_back(section);
  }
  return all;
}

}  // namespace

std::vector<std::uint32_t> addSkeleton(StrandGraph& graph, const ElementSkeleton& skeleton,
                                       std::uint32_t element, VesselKind kind) {
  const Strokes strokes(skeleton);
  struct Run {
    std::vector<Tip> chain;
    Sections sections;
    float length;
  };
  std::vector<Run> runs;
  for (std::vector<Tip>& chain : strokes.chains()) {
    Sections sections = sectionsAlong(skeleton, chain);
    if (sections.size() < 2) continue;
    const float length = lengthOf(sections);
    runs.push_back({std::move(chain), std::move(sections), length});
  }
  std::ranges::stable_sort(runs, std::greater{}, &Run::length);

  std::vector<std::uint32_t> added;
  std::map<std::uint32_t, std::uint32_t> hostAt;           // node -> the strand that passes through it
  std::map<std::uint32_t, std::vector<StrandEnd>> endsAt;  // node -> strand ends
  for (Run& run : runs) {
    const std::uint32_t strand = graph.add({std::move(run.sections), element, kind, kNone, kNone});
    added.push_back(strand);
    for (std::size_t i = 1; i + 1 < run.chain.size(); i += 2) hostAt[strokes.nodeOf(run.chain[i])] = strand;
    endsAt[strokes.nodeOf(run.chain.front())].push_back({strand, false});
    endsAt[strokes.nodeOf(run.chain.back())].push_back({strand, true});
  }
  for (const auto& [node, ends] : endsAt) {
    const auto host = hostAt.find(node);
    const bool hosted = host != hostAt.end();
    if (!hosted && ends.size() < 2) continue;
    graph.join(hosted ? std::optional(host->second) : std::nullopt, skeleton.nodes[node].position, ends);
  }
  return added;
}

}  // namespace vasa
