#include "math/closest_point.h"

namespace vasa {
namespace {

TrianglePoint closestOnEdges(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 corners[3] = {a, b, c};
  TrianglePoint best{a, {1, 0, 0}};
  float bestDistance2 = glm::dot(p - a, p - a);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const float t = closestOnSegment(p, corners[i], corners[j]);
    const vec3 q = glm::mix(corners[i], corners[j], t);
    const float distance2 = glm::dot(p - q, p - q);
    if (distance2 >= bestDistance2) continue;
    bestDistance2 = distance2;
    best = {q, vec3(0)};
    best.barycentric[i] = 1 - t;
    best.barycentric[j] = t;
  }
  return best;
}

}  // namespace

TrianglePoint closestOnTriangle(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 ab = b - a, ac = c - a;
  const vec3 normal = glm::cross(ab, ac);
  const float area2 = glm::dot(normal, normal);
  if (area2 <= 0) return closestOnEdges(p, a, b, c);
  const vec3 ap = p - a;
  const float v = glm::dot(glm::cross(ap, ac), normal) / area2;
  const float w = glm::dot(glm::cross(ab, ap), normal) / area2;
  const float u = 1 - v - w;
  if (u >= 0 && v >= 0 && w >= 0) return {u * a + v * b + w * c, {u, v, w}};
  return closestOnEdges(p, a, b, c);
}

}  // namespace vasa
