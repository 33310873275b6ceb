#pragma once
#include <array>
#include <map>
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa::test {

/// Edges that do not belong to exactly two triangles, one in each direction.
inline std::size_t openEdges(std::span<const uvec3> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const uvec3& t : triangles)
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) ++open;
  }
  return open;
}

/// The triangles with vertices that have the same position, bit for bit, made one.
inline std::vector<uvec3> weldedByBits(std::span<const vec3> positions, std::span<const uvec3> triangles) {
  std::map<std::array<float, 3>, std::uint32_t> first;
  std::vector<std::uint32_t> same;
  for (const vec3& p : positions)
    same.push_back(first.try_emplace({p.x, p.y, p.z}, std::uint32_t(same.size())).first->second);
  std::vector<uvec3> welded;
  for (const uvec3& t : triangles) welded.push_back({same[t.x], same[t.y], same[t.z]});
  return welded;
}

/// A triangle that looks the other way than its vertices' normals.
inline bool flipped(std::span<const vec3> positions, std::span<const vec3> normals, const uvec3& t) {
  const dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
  return glm::dot(glm::cross(b - a, c - a), dvec3(normals[t.x] + normals[t.y] + normals[t.z])) <= 0;
}

}  // namespace vasa::test
