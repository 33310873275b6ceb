#pragma once
#include <vector>

#include "mesh/triangle_tree.h"

namespace vasa {

/// Takes sections out that a coarse mesh tells nothing of: in runs longer than kUntoldRadii radii, those that
/// no vertex is beside. What lies there is facets from one ring of the mesh to the next, whose corners a
/// spline would need many spans to follow. First and last stay. O(sections · triangles near by)
/// @param sections  (x, y, z, r) [m] of one branch; @param mesh, tree  of the surface around it
void dropUntold(std::vector<vec4>& sections, const TriangleMesh& mesh, const TriangleTree& tree);
constexpr float kUntoldRadii = 4;

}  // namespace vasa
