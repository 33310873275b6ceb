#pragma once
#include "mesh/triangle_mesh.h"

namespace vasa {

/// Triangles that look against the normals of their corners (surface/fork_check.h, mesh/triangle_mesh.h). O(n).
std::vector<std::uint32_t> foldedTriangles(const TriangleMesh& mesh);

/// Moves the corners of triangles that fold towards the middle of their neighbours, step by step until none folds; where
/// that does not help soon, their neighbours too. Everything else stays where it is.
/// @param fixed  so many vertices, the first ones, stay in any case
/// @return triangles that fold yet. O(steps · n)
std::size_t unfold(TriangleMesh& mesh, std::size_t fixed);

}  // namespace vasa
