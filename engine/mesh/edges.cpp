#include "mesh/edges.h"

#include <algorithm>
#include <numeric>

#include "core/cancellation.h"

namespace vasa {

MeshEdges buildEdges(const TriangleMesh& mesh) {
  struct Side {
    std::uint64_t key;
    std::uint32_t triangle, corner;
  };
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][int(k)], b = mesh.triangles[t][int((k + 1) % 3)];
      sides.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), t, k});
    }
  Checkpoints checkpoints;
  std::sort(sides.begin(), sides.end(), [&checkpoints](const Side& l, const Side& r) {
    checkpoints.pass();
    return l.key != r.key             ? l.key < r.key
           : l.triangle != r.triangle ? l.triangle < r.triangle
                                      : l.corner < r.corner;
  });
  MeshEdges edges;
  edges.ofTriangle.resize(mesh.triangles.size());
  edges.triangles.reserve(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    checkpoints.pass();
    if (i == 0 || sides[i].key != sides[i - 1].key) {
      edges.vertices.push_back({std::uint32_t(sides[i].key >> 32), std::uint32_t(sides[i].key)});
      edges.firstTriangle.push_back(std::uint32_t(i));
    }
    edges.ofTriangle[sides[i].triangle][int(sides[i].corner)] = std::uint32_t(edges.vertices.size() - 1);
    edges.triangles.push_back(sides[i].triangle);
  }
  edges.firstTriangle.push_back(std::uint32_t(sides.size()));
  return edges;
}

VertexTriangles buildVertexTriangles(const TriangleMesh& mesh) {
  VertexTriangles result;
  result.first.assign(mesh.positions.size() + 1, 0);
  for (const uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++result.first[t[k] + 1];
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.triangles.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) result.triangles[next[mesh.triangles[i][k]]++] = i;
  return result;
}

}  // namespace vasa
