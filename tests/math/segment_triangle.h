#pragma once
#include "math/types.h"

namespace vasa::test {

/// Where a segment and a triangle come nearest.
struct SegmentTrianglePoint {
  float s = 0;       ///< on the segment, in [0, 1]
  vec3 point;        ///< on the triangle
  vec3 barycentric;  ///< weights of a, b, c; non-negative, sum 1
  float distance = 0;
};

/// Nearest points of segment p q and triangle abc, either of which may be degenerate: distance 0 where the
/// segment pierces the triangle, else the least of ends against triangle and segment against edges.
SegmentTrianglePoint closestOnSegmentTriangle(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c);

}  // namespace vasa::test
