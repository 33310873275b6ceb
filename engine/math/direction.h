#pragma once
#include "math/types.h"

namespace vasa {

/// The unit vector along v; `otherwise` where v is too short to tell.
inline vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length = glm::length(v);
  return length > 1e-9f ? v / length : otherwise;
}

/// The shortest turn from one direction to another, of any lengths; none where either is missing.
inline quat turnBetween(vec3 from, vec3 to) {
  from = unitOr(from, vec3(0)), to = unitOr(to, vec3(0));
  if (from == vec3(0) || to == vec3(0)) return quat(1, 0, 0, 0);
  const float cosine = glm::dot(from, to);
  if (cosine < -0.9999f) return glm::angleAxis(kPi, anyPerpendicular(from));
  return glm::normalize(quat(1 + cosine, glm::cross(from, to)));
}

}  // namespace vasa
