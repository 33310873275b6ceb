#pragma once
#include <span>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// Turns the triangles of vessels' walls so that they look away from the vessels' axes: each piece that hangs
/// together through edges by the vote of its area, whatever way the source has it. So torn walls, and such of
/// which a part is inside out, have one inside.
/// @param axes  places on the axes of all its vessels, dense beside their radii; not empty
/// O(triangles · axes).
void turnOutward(TriangleMesh& mesh, std::span<const vec3> axes);

}  // namespace vasa
