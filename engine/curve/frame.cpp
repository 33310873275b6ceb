#include "curve/frame.h"

#include <cassert>

#include "curve/bspline.h"
#include "math/direction.h"

namespace vasa {
namespace {

Frame frameFrom(vec3 tangent, vec3 reference) {
  vec3 u = reference - glm::dot(reference, tangent) * tangent;
  const float length2 = glm::dot(u, u);
  u = length2 > 1e-12f ? u / std::sqrt(length2) : anyPerpendicular(tangent);
  return {u, glm::cross(tangent, u), tangent};
}

// One double-reflection step from a section to the next.
vec3 transport(vec3 u, vec3 from, vec3 fromTangent, vec3 to, vec3 toTangent) {
  const vec3 v1 = to - from;
  const float c1 = glm::dot(v1, v1);
  vec3 tangent = fromTangent;
  if (c1 > kTiny2) {
    u -= (2 / c1) * glm::dot(v1, u) * v1;
    tangent -= (2 / c1) * glm::dot(v1, tangent) * v1;
  }
  const vec3 v2 = toTangent - tangent;
  const float c2 = glm::dot(v2, v2);
  if (c2 > kTiny2) u -= (2 / c2) * glm::dot(v2, u) * v2;
  return u;
}

// Of one span of a vessel; where that is a point, of the whole.
vec3 tangentAt(const Bezier& segment, float t, std::span<const vec4> points) {
  for (const vec3 candidate : {vec3(segment.derivative(t)), vec3(segment.b[3] - segment.b[0]),
                               vec3(points.back() - points.front())}) {
    const float length2 = glm::dot(candidate, candidate);
    if (length2 > kTiny2) return candidate / std::sqrt(length2);
  }
  return {0, 0, 1};
}

quat toQuaternion(const Frame& frame) {
  return glm::normalize(glm::quat_cast(mat3(frame.u, frame.v, frame.tangent)));
}

}  // namespace

void minimisingFrames(std::span<const vec3> points, std::span<const vec3> tangents, vec3 start,
                      std::span<Frame> frames) {
  assert(points.size() == tangents.size() && points.size() == frames.size());
  if (points.empty()) return;
  frames[0] = frameFrom(tangents[0], start);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const vec3 u = transport(frames[i - 1].u, points[i - 1], tangents[i - 1], points[i], tangents[i]);
    frames[i] = frameFrom(tangents[i], u);
  }
}

vec3 unitTangent(std::span<const vec4> points, float u) {
  const auto [span, t] = locate(u, spanCount(points));
  return tangentAt(bezierOfSpan(points, span), t, points);
}

void knotFrames(std::span<const vec4> points, vec3 start, std::span<quat> frames) {
  const std::uint32_t spans = spanCount(points);
  assert(frames.size() == spans + 1);
  Frame frame = frameFrom(unitTangent(points, 0), start);
  vec3 position(points[0]);
  frames[0] = toQuaternion(frame);
  Bezier segment = bezierOfSpan(points, 0);
  for (std::uint32_t span = 0; span < spans; ++span) {
    for (int step = 1; step <= kFrameSteps; ++step) {
      float t = float(step) / kFrameSteps;
      if (step == kFrameSteps &&
          span + 1 < spans) {  // a knot is where the next span begins, as in evaluate()
        segment = bezierOfSpan(points, span + 1);
        t = 0;
      }
      const vec3 next(segment.at(t)), tangent = tangentAt(segment, t, points);
      frame = frameFrom(tangent, transport(frame.u, position, frame.tangent, next, tangent));
      position = next;
    }
    quat q = toQuaternion(frame);
    if (glm::dot(q, frames[span]) < 0) q = -q;
    frames[span + 1] = q;
  }
}

Frame interpolateFrame(const quat& from, const quat& to, float t, vec3 tangent) {
  const quat q = glm::normalize(from * (1 - t) + to * t);
  return frameFrom(tangent, q * vec3(1, 0, 0));
}

}  // namespace vasa
