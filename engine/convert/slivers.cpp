#include "convert/slivers.h"

#include <algorithm>
#include <map>

#include "core/disjoint_sets.h"
#include "core/ids.h"

namespace vasa {
namespace {

struct Wall {
  std::uint32_t strand;
  float area = 0, length = 0;
  float radius() const { return length > 0 ? area / (2 * kPi * length) : 0; }
};

Wall wallOf(const StrandGraph& graph, std::uint32_t strand) {
  Wall wall{strand};
  const Sections& sections = graph.strands[strand].sections;
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const float length = glm::distance(vec3(sections[i - 1]), vec3(sections[i]));
    wall.length += length;
    wall.area += kPi * (sections[i - 1].w + sections[i].w) * length;
  }
  return wall;
}

// Connected parts among strands, one left out.
std::size_t partsWithout(const StrandGraph& graph, std::span<const Wall> walls, std::uint32_t left) {
  std::map<std::uint32_t, std::uint32_t> alive;  // strand -> its number among these
  for (const Wall& wall : walls)
    if (wall.strand != left && !graph.strands[wall.strand].dropped())
      alive.emplace(wall.strand, std::uint32_t(alive.size()));
  DisjointSets sets(alive.size());
  std::size_t parts = alive.size();
  std::map<std::uint32_t, std::uint32_t> atJoint;  // joint -> some strand's number there
  const auto touch = [&](std::uint32_t joint, std::uint32_t number) {
    if (sets.unite(atJoint.try_emplace(joint, number).first->second, number)) --parts;
  };
  for (const auto& [strand, number] : alive)
    for (const std::uint32_t joint : {graph.strands[strand].startJoint, graph.strands[strand].endJoint}) {
      if (joint == kNone) continue;
      touch(joint, number);
      if (!graph.joints[joint].host) continue;
      if (const auto host = alive.find(*graph.joints[joint].host); host != alive.end())
        touch(joint, host->second);
    }
  return parts;
}

}  // namespace

std::uint32_t pruneSlivers(StrandGraph& graph, std::span<const std::uint32_t> strands,
                           const SliverOptions& options) {
  if (strands.size() < 2) return 0;
  std::vector<Wall> walls;
  for (const std::uint32_t strand : strands) walls.push_back(wallOf(graph, strand));
  std::ranges::stable_sort(walls, {}, &Wall::area);
  float area = 0, length = 0;
  for (const Wall& wall : walls) area += wall.area, length += wall.length;
  if (!(area > 0)) return 0;
  // Weighted by area, so that the threads themselves do not pull the mean down.
  float radius = 0;
  for (const Wall& wall : walls) radius += wall.radius() * wall.area / area;

  std::uint32_t dropped = 0;
  float gone = 0;
  for (bool again = true; again;) {
    again = false;
    for (const Wall& wall : walls) {
      if (graph.strands[wall.strand].dropped() || wall.area > options.areaShare * area) continue;
      if (wall.radius() > options.radiusShare * radius && wall.length > options.lengthRadii * radius)
        continue;
      if (gone + wall.area > options.pruned * area) break;
      if (partsWithout(graph, walls, wall.strand) > partsWithout(graph, walls, kNone)) continue;
      const bool hosts =
          std::ranges::any_of(graph.joints, [&](const Joint& j) { return j.host == wall.strand; });
      if (hosts) continue;
      graph.drop(wall.strand);
      gone += wall.area;
      ++dropped;
      again = true;
    }
  }
  return dropped;
}

}  // namespace vasa
