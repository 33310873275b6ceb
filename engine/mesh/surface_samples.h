#pragma once
#include <vector>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// Points spread over the surface, each standing for the same share of its area: systematic sampling along
/// the running sum of the triangles' areas, inside a triangle at a low-discrepancy place. A pure function of
/// the mesh and the count. Empty for a mesh without area.
std::vector<vec3> sampleSurface(const TriangleMesh& mesh, std::size_t count);

}  // namespace vasa
