#pragma once
#include "mesh/triangle_mesh.h"

namespace vasa {

/// The mesh with near vertices made one, and without what no algorithm can use: triangles with a position
/// that is not finite, with an index out of range, with two equal corners after welding, and repeated ones
/// (the same three corners in any order: the first stays). Unused vertices go. Order is otherwise kept.
/// @param tolerance  [m] >= 0; a vertex joins the first earlier one within this distance; 0 welds equal ones
/// Never fails. Expected O(n): a hash grid of the tolerance's size.
TriangleMesh weld(const TriangleMesh& mesh, float tolerance);

}  // namespace vasa
