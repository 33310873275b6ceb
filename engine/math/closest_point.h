#pragma once
#include "math/types.h"

namespace vasa {

/// Parameter in [0, 1] of the point on segment ab that is nearest to p; 0 where a == b.
inline float closestOnSegment(vec3 p, vec3 a, vec3 b) {
  const vec3 ab = b - a;
  const float length2 = glm::dot(ab, ab);
  if (length2 <= 0) return 0;
  return glm::clamp(glm::dot(p - a, ab) / length2, 0.0f, 1.0f);
}

struct TrianglePoint {
  vec3 point;
  vec3 barycentric;  ///< weights of a, b, c; non-negative, sum 1
};

/// The point of triangle abc nearest to p (Ericson 2005, Real-Time Collision Detection, 5.1.5).
/// Degenerate triangles are treated as their longest edge.
TrianglePoint closestOnTriangle(vec3 p, vec3 a, vec3 b, vec3 c);

}  // namespace vasa
