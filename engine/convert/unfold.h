#pragma once
#include <span>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// Triangles that look against the normals of their corners (surface/fork_check.h, mesh/triangle_mesh.h).
/// O(n).
/// @param held  normals that the first vertices have whatever their triangles
std::vector<std::uint32_t> foldedTriangles(const TriangleMesh& mesh, std::span<const vec3> held = {});

/// Moves the corners of triangles that fold towards the middle of their neighbours, step by step until none
/// folds; where that does not help soon, their neighbours too. Everything else stays where it is.
/// @param held  normals of the first vertices, which stay in any case
/// @return triangles that fold yet. O(steps · n)
std::size_t unfold(TriangleMesh& mesh, std::span<const vec3> held);

}  // namespace vasa
