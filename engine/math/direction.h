#pragma once
#include <cmath>

#include "math/types.h"

namespace vasa {

/// A vector whose square is no larger has no direction, as in the shaders (lib/section.glsl).
constexpr float kTiny2 = 1e-20f;

/// The unit vector along v; `otherwise` where v is too short to tell.
inline vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length2 = glm::dot(v, v);
  return length2 > kTiny2 ? v / std::sqrt(length2) : otherwise;
}

/// The unit vector along v, zero where there is none.
inline vec3 directionOf(vec3 v) { return unitOr(v, vec3(0)); }

/// The shortest turn from one direction to another, of any lengths; none where either is missing.
inline quat turnBetween(vec3 from, vec3 to) {
  from = directionOf(from), to = directionOf(to);
  if (from == vec3(0) || to == vec3(0)) return quat(1, 0, 0, 0);
  const float cosine = glm::dot(from, to);
  if (cosine < -0.9999f) return glm::angleAxis(kPi, anyPerpendicular(from));
  return glm::normalize(quat(1 + cosine, glm::cross(from, to)));
}

/// The rotation in a transform, whatever its scale; where it is sheared, of its x axis and of its y axis
/// beside that.
inline quat rotationOf(const mat4& transform) {
  const vec3 x = directionOf(vec3(transform[0]));
  const vec3 y = directionOf(vec3(transform[1]) - glm::dot(vec3(transform[1]), x) * x);
  return glm::normalize(glm::quat_cast(mat3(x, y, glm::cross(x, y))));
}

}  // namespace vasa
