#pragma once
#include "math/types.h"

namespace vasa {

/// Three corners.
struct Triangle {
  vec3 a, b, c;
};

/// Whether two triangles cross: an edge of one pierces the other.
/// Method: each triangle against the other's plane, then the two intervals in which they cut the line that
/// the planes share (Möller 1997, "A fast triangle-triangle intersection test"). Triangles in one plane do
/// not cross, nor do those that only touch within rounding.
bool trianglesCross(const Triangle& first, const Triangle& second);

}  // namespace vasa
