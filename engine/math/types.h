#pragma once
// House units: metres, seconds, radians; right-handed, +Y up; quaternions x y z w in memory, as in glTF.
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace vasa {

using glm::dvec3;
using glm::dvec4;
using glm::ivec3;
using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kPi = 3.14159265358979323846f;

/// Some unit vector at right angles to the unit vector n, continuous except near n = -z
/// (Duff et al. 2017, "Building an orthonormal basis, revisited").
inline vec3 anyPerpendicular(vec3 n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

}  // namespace vasa
