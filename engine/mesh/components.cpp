#include "mesh/components.h"

namespace vasa {

std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh, const MeshEdges& edges) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  DisjointSets sets(mesh.triangles.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t t : edges.trianglesOf(e)) sets.unite(t, edges.trianglesOf(e)[0]);

  std::vector<TriangleMesh> parts;
  std::vector<std::uint32_t> partOf(mesh.triangles.size(), kNone);
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t root = sets.find(t);
    if (root == t) {
      partOf[t] = std::uint32_t(members.size());
      members.emplace_back();
    }
    members[partOf[root]].push_back(t);
  }
  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  for (const auto& triangles : members) {
    TriangleMesh& part = parts.emplace_back();
    for (const std::uint32_t t : triangles) {
      uvec3 corners = mesh.triangles[t];
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& n = number[corners[k]];
        if (n == kNone) {
          n = std::uint32_t(part.positions.size());
          part.positions.push_back(mesh.positions[corners[k]]);
        }
        corners[k] = n;
      }
      part.triangles.push_back(corners);
    }
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) number[mesh.triangles[t][k]] = kNone;
  }
  return parts;
}

}  // namespace vasa
