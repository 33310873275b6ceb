#pragma once
#include "mesh/edges.h"

namespace vasa {

/// Distance along the surface from a set of vertices, one value a vertex [m]; infinite where none leads
/// there. Method: fast marching on triangles (Kimmel & Sethian 1998): a front that is straight inside each
/// triangle, along edges where the triangle gives none (obtuse ones). O(n log n), deterministic.
/// @param sources  at least one
std::vector<float> surfaceDistance(const TriangleMesh& mesh, const VertexTriangles& around,
                                   std::span<const std::uint32_t> sources);

/// The vertex with the greatest finite distance; the first of equals.
std::uint32_t farthest(std::span<const float> distance);

}  // namespace vasa
