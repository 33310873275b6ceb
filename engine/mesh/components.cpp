#include "mesh/components.h"

#include <algorithm>
#include <tuple>

#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

// @param number  kNone of every vertex, before and after
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                    std::vector<std::uint32_t>& number) {
  TriangleMesh part;
  Checkpoints checkpoints;
  for (const std::uint32_t t : triangles) {
    checkpoints.pass();
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
  return part;
}

}  // namespace

DisjointSets joinedVertices(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices) {
  DisjointSets sets(mesh.positions.size());
  for (const uvec3& t : mesh.triangles) sets.unite(t.x, t.y), sets.unite(t.x, t.z);
  const auto place = [&](std::uint32_t v) {
    const vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(vertices, {}, place);
  for (std::size_t i = 1; i < vertices.size(); ++i)
    if (place(vertices[i - 1]) == place(vertices[i])) sets.unite(vertices[i - 1], vertices[i]);
  return sets;
}

TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  return partOf(mesh, triangles, number);
}

void appendMesh(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const uvec3& t : more.triangles) mesh.triangles.push_back(t + first);
}

std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.triangles.size());
  std::vector<std::uint32_t> firstAt(mesh.positions.size(), kNone);
  Checkpoints checkpoints;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      checkpoints.pass();
      std::uint32_t& first = firstAt[mesh.triangles[t][k]];
      if (first == kNone) first = t;
      sets.unite(first, t);
    }

  std::vector<TriangleMesh> parts;
  std::vector<std::uint32_t> ordinal(mesh.triangles.size(), kNone);
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    checkpoints.pass();
    const std::uint32_t root = sets.find(t);
    if (root == t) {
      ordinal[t] = std::uint32_t(members.size());
      members.emplace_back();
    }
    members[ordinal[root]].push_back(t);
  }
  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  for (const auto& triangles : members) parts.push_back(partOf(mesh, triangles, number));
  return parts;
}

}  // namespace vasa
