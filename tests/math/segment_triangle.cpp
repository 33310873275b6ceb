#include "segment_triangle.h"

#include "math/closest_point.h"
#include "math/segment_distance.h"

namespace vasa::test {
namespace {

// Set where the segment passes through the triangle's inside: signed volumes of the segment with the three
// edges.
bool pierces(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c, SegmentTrianglePoint& at) {
  const vec3 normal = glm::cross(b - a, c - a);
  const float heightP = glm::dot(p - a, normal), heightQ = glm::dot(q - a, normal);
  if (heightP * heightQ > 0 || heightP == heightQ) return false;
  const float s = heightP / (heightP - heightQ);
  const vec3 x = glm::mix(p, q, s);
  const float area2 = glm::dot(normal, normal);
  const float v = glm::dot(glm::cross(x - a, c - a), normal) / area2;
  const float w = glm::dot(glm::cross(b - a, x - a), normal) / area2;
  if (!(v >= 0 && w >= 0 && v + w <= 1)) return false;
  at = {s, x, {1 - v - w, v, w}, 0};
  return true;
}

}  // namespace

SegmentTrianglePoint closestOnSegmentTriangle(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
  SegmentTrianglePoint best;
  if (pierces(p, q, a, b, c, best)) return best;
  const TrianglePoint fromP = closestOnTriangle(p, a, b, c), fromQ = closestOnTriangle(q, a, b, c);
  best = {0, fromP.point, fromP.barycentric, glm::distance(p, fromP.point)};
  if (const float distance = glm::distance(q, fromQ.point); distance < best.distance)
    best = {1, fromQ.point, fromQ.barycentric, distance};
  const vec3 corners[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const auto near = closestOnSegments(p, q, corners[i], corners[j]);
    if (near.distance >= best.distance) continue;
    vec3 weights(0);
    weights[i] = 1 - near.t;
    weights[j] = near.t;
    best = {near.s, glm::mix(corners[i], corners[j], near.t), weights, near.distance};
  }
  return best;
}

}  // namespace vasa::test
