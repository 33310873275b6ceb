#pragma once
#include "mesh/edges.h"

namespace vasa {

/// A closed walk along border edges (edges with one triangle).
struct BoundaryLoop {
  std::vector<std::uint32_t> vertices;  ///< each once
  std::vector<std::uint32_t> edges;     ///< edges[i] joins vertices[i] and the next
};

/// The borders of a mesh as loops; where several meet at a vertex they are taken apart into simple ones.
/// Border edges that belong to no loop (possible where the mesh is non-manifold) are left out. O(n).
std::vector<BoundaryLoop> boundaryLoops(const TriangleMesh& mesh, const MeshEdges& edges);

/// The mesh with every loop closed by triangles between its vertices, oriented as what lies beside it. Ears
/// are cut off in the order of the shortest new edge, so that a long slit closes like a zip and a round hole
/// like a lid. The mesh's own vertices and triangles keep their numbers. O(n log n).
TriangleMesh fillLoops(const TriangleMesh& mesh, const MeshEdges& edges, std::span<const BoundaryLoop> loops);

}  // namespace vasa
