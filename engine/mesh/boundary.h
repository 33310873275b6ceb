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

/// The mesh with every loop closed by a fan around the loop's mean point (three edges: one triangle),
/// oriented as the triangles beside it. The mesh's own vertices and triangles keep their numbers.
TriangleMesh fillLoops(const TriangleMesh& mesh, const MeshEdges& edges, std::span<const BoundaryLoop> loops);

}  // namespace vasa
