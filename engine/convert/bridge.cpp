#include "convert/bridge.h"

#include <algorithm>

#include "core/disjoint_sets.h"

namespace vasa {
namespace {

struct FreeEnd {
  std::uint32_t node;
  vec3 position, direction;  // outwards
  float radius;
};

FreeEnd freeEnd(const ElementBranch& branch, bool last) {
  const auto at = [&](std::size_t i) { return branch.sections[last ? branch.sections.size() - 1 - i : i]; };
  const vec4 tip = at(0);
  float radius = tip.w;
  std::size_t i = 1;
  while (i + 1 < branch.sections.size() && glm::distance(vec3(at(i)), vec3(tip)) < 2 * radius) {
    radius = std::max(radius, at(i).w);
    ++i;
  }
  return {last ? branch.endNode : branch.startNode, vec3(tip), glm::normalize(vec3(tip) - vec3(at(i))),
          radius};
}

std::vector<FreeEnd> freeEnds(const ElementSkeleton& skeleton) {
  std::vector<FreeEnd> ends;
  for (const ElementBranch& branch : skeleton.branches)
    for (const bool last : {false, true})
      if (skeleton.nodes[last ? branch.endNode : branch.startNode].valence == 1)
        ends.push_back(freeEnd(branch, last));
  return ends;
}

bool faces(const FreeEnd& a, const FreeEnd& b, float bridgeRadii, float detail) {
  const float thick = std::max(a.radius, b.radius), thin = std::min(a.radius, b.radius);
  const vec3 gap = b.position - a.position;
  const float distance = glm::length(gap);
  if (distance > std::max(bridgeRadii * thick, detail) || thick > 2 * thin) return false;
  if (glm::dot(a.direction, b.direction) > -0.5f) return false;
  if (distance < 0.5f * thin) return true;  // touching: the gap's own direction says nothing
  return glm::dot(a.direction, gap) > 0.7f * distance && glm::dot(b.direction, gap) < -0.7f * distance;
}

void turn(ElementBranch& branch) {
  std::swap(branch.startNode, branch.endNode);
  std::reverse(branch.sections.begin(), branch.sections.end());
}

void join(ElementSkeleton& skeleton, std::uint32_t nodeA, std::uint32_t nodeB) {
  const auto branchAt = [&](std::uint32_t node) {
    return std::find_if(skeleton.branches.begin(), skeleton.branches.end(),
                        [&](const ElementBranch& b) { return b.startNode == node || b.endNode == node; });
  };
  auto a = branchAt(nodeA), b = branchAt(nodeB);
  if (a->endNode != nodeA) turn(*a);
  if (b->startNode != nodeB) turn(*b);
  // Ends that overlap must not run back: sections of the second that lie behind the first's end are left out.
  const vec3 tip(a->sections.back());
  const vec3 ahead = tip - vec3(a->sections[a->sections.size() - 2]);
  std::size_t from = 0;
  while (from + 1 < b->sections.size() && glm::dot(vec3(b->sections[from]) - tip, ahead) <= 0) ++from;
  a->sections.insert(a->sections.end(), b->sections.begin() + std::ptrdiff_t(from), b->sections.end());
  a->endNode = b->endNode;
  skeleton.nodes[nodeA].valence = skeleton.nodes[nodeB].valence = 0;
  skeleton.branches.erase(b);
}

}  // namespace

std::uint32_t bridgeGaps(ElementSkeleton& skeleton, float bridgeRadii, float detail) {
  const std::vector<FreeEnd> ends = freeEnds(skeleton);
  DisjointSets pieces(skeleton.nodes.size());
  for (const ElementBranch& branch : skeleton.branches) pieces.unite(branch.startNode, branch.endNode);
  struct Crossing {
    float distance;
    std::uint32_t a, b;
  };
  std::vector<Crossing> gaps;
  for (std::uint32_t i = 0; i < ends.size(); ++i)
    for (std::uint32_t j = i + 1; j < ends.size(); ++j)
      if (pieces.find(ends[i].node) != pieces.find(ends[j].node) &&
          faces(ends[i], ends[j], bridgeRadii, detail))
        gaps.push_back({glm::distance(ends[i].position, ends[j].position), i, j});
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const Crossing& a, const Crossing& b) { return a.distance < b.distance; });
  std::uint32_t closed = 0;
  for (const Crossing& gap : gaps) {
    const std::uint32_t a = ends[gap.a].node, b = ends[gap.b].node;
    if (pieces.find(a) == pieces.find(b) || skeleton.nodes[a].valence != 1 || skeleton.nodes[b].valence != 1)
      continue;
    pieces.unite(a, b);
    join(skeleton, a, b);
    ++closed;
  }
  return closed;
}

void dropUnusedNodes(ElementSkeleton& skeleton) {
  std::vector<std::uint32_t> number(skeleton.nodes.size());
  std::vector<ElementNode> kept;
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    number[i] = std::uint32_t(kept.size());
    if (skeleton.nodes[i].valence > 0) kept.push_back(skeleton.nodes[i]);
  }
  for (ElementBranch& branch : skeleton.branches)
    branch.startNode = number[branch.startNode], branch.endNode = number[branch.endNode];
  skeleton.nodes = std::move(kept);
}

}  // namespace vasa
