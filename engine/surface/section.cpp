#include "surface/section.h"

#include <algorithm>
#include <cmath>

#include "surface/reference.h"

// The specification of shaders/lib/section.glsl: same operations in the same order, so that both round alike.
//
// The normal: with a frame that does not spin about T, d' = −|C'| (κ·d) T, hence
//   S_t = C' + r' d + r d' = |C'| (1 − r κ·d) T + r' d,   S_θ = r d_θ,
// and N = d − a T is at right angles to both for a = r' / (|C'| (1 − r κ·d)). A spin adds a multiple of
// d_θ to S_t, which leaves N as it is; so any frame perpendicular to T will do.
namespace vasa {
namespace {

constexpr float kFoldGuard = 0.1f;  // least 1 − r κ·d

vec3 tangentOf(const Bezier& bezier, vec3 derivative, vec3 vesselChord) {
  for (const vec3 candidate : {derivative, vec3(bezier.b[3] - bezier.b[0]), vesselChord}) {
    const float length2 = glm::dot(candidate, candidate);
    if (length2 > kTiny2) return candidate / std::sqrt(length2);
  }
  return {0, 0, 1};
}

}  // namespace

Section sectionAt(const Bezier& bezier, vec3 vesselChord, const quat& from, const quat& to, float t) {
  const vec4 point = bezier.at(t), first = bezier.derivative(t);
  const vec3 velocity(first), acceleration(bezier.secondDerivative(t));
  Section section;
  section.centre = vec3(point);
  section.radius = std::max(point.w, 0.0f);
  section.frame = interpolateFrame(from, to, t, tangentOf(bezier, velocity, vesselChord));
  const float speed2 = glm::dot(velocity, velocity);
  if (speed2 > kTiny2) {
    const vec3& tangent = section.frame.tangent;
    section.slope = first.w / std::sqrt(speed2);
    section.curvature = (acceleration - glm::dot(acceleration, tangent) * tangent) / speed2;
  }
  return section;
}

SurfacePoint surfacePoint(const Section& section, vec2 direction) {
  const vec3 d = direction.x * section.frame.u + direction.y * section.frame.v;
  const float fold = std::max(1.0f - section.radius * glm::dot(section.curvature, d), kFoldGuard);
  const vec3 normal = d - (section.slope / fold) * section.frame.tangent;
  return {section.centre + section.radius * d, normal / std::sqrt(glm::dot(normal, normal))};
}

SurfacePoint capPoint(const Section& section, vec2 direction, vec2 polar, float outward) {
  if (polar.y == 0) return surfacePoint(section, direction);
  const vec3 d = direction.x * section.frame.u + direction.y * section.frame.v;
  const vec3 normal = polar.x * d + (outward * polar.y) * section.frame.tangent;
  return {section.centre + section.radius * normal, normal / std::sqrt(glm::dot(normal, normal))};
}

}  // namespace vasa
