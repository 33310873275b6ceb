#pragma once
#include <span>

#include "core/disjoint_sets.h"
#include "mesh/edges.h"

namespace vasa {

/// The parts of a mesh that hang together through vertices, in the order of their first triangles. A common
/// vertex is enough: decimated thin tubes fall into triangles that share no edge. O(n).
std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh);

/// What of a mesh hangs together by triangles, and where places of some of its vertices are the same, as
/// where parts of several materials meet, which share none. O(n log n).
DisjointSets joinedVertices(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices);

/// Some of a mesh's triangles, with the vertices that they use. O(n).
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

/// Adds a mesh's vertices and triangles to another's.
void appendMesh(TriangleMesh& mesh, const TriangleMesh& more);

}  // namespace vasa
