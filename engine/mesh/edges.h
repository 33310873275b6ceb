#pragma once
#include <span>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// Which triangles meet at each edge. Holds for any triangle soup: an edge may have one triangle (a border),
/// two, or more (non-manifold).
struct MeshEdges {
  std::vector<uvec2> vertices;               ///< an edge's two vertices, low < high; edges in ascending order
  std::vector<uvec3> ofTriangle;             ///< edge k of a triangle joins its corners k and (k + 1) % 3
  std::vector<std::uint32_t> firstTriangle;  ///< edges + 1 offsets into `triangles`
  std::vector<std::uint32_t> triangles;      ///< edge after edge, ascending

  std::size_t size() const { return vertices.size(); }
  std::span<const std::uint32_t> trianglesOf(std::uint32_t edge) const {
    return std::span(triangles).subspan(firstTriangle[edge], firstTriangle[edge + 1] - firstTriangle[edge]);
  }
};

/// O(n log n). No triangle may name a vertex twice (mesh/weld.h).
MeshEdges buildEdges(const TriangleMesh& mesh);

/// The triangles around each vertex, in ascending order.
struct VertexTriangles {
  std::vector<std::uint32_t> first;  ///< vertices + 1 offsets
  std::vector<std::uint32_t> triangles;

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(triangles).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};
VertexTriangles buildVertexTriangles(const TriangleMesh& mesh);

}  // namespace vasa
