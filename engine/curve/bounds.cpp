#include "curve/bounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

// C(t) - L(t) = 3t(1-t) [(1-t) e1 + t e2] with e1 = b1 - (2 b0 + b3)/3, e2 = b2 - (b0 + 2 b3)/3 and L the
// chord at the same parameter; 3t(1-t) <= 3/4 and the bracket is a mean, hence ¾ max |e|. With the second
// differences D1, D2: e1 = -(2 D1 + D2)/3, e2 = -(D1 + 2 D2)/3, so max |e| <= K.
namespace vasa {
namespace {

// A sample's rounding error grows with the coordinates, not with the tube's size.
float rounding(const Bezier& segment) {
  float largest = 0;
  for (const vec4& point : segment.b)
    for (int axis = 0; axis < 4; ++axis) largest = std::max(largest, std::abs(point[axis]));
  return 8 * std::numeric_limits<float>::epsilon() * largest;
}

}  // namespace

float filipConstant(const Bezier& segment) {
  const auto& b = segment.b;
  return std::max(glm::length(vec3(b[0] - 2.0f * b[1] + b[2])), glm::length(vec3(b[1] - 2.0f * b[2] + b[3])));
}

float filipRadiusConstant(const Bezier& segment) {
  const auto& b = segment.b;
  return std::max(std::abs(b[0].w - 2 * b[1].w + b[2].w), std::abs(b[1].w - 2 * b[2].w + b[3].w));
}

float filipBound(float filipConstant, int level) { return std::ldexp(3 * filipConstant, -2 * (level + 1)); }

float radiusBound(const Bezier& segment) {
  const auto& b = segment.b;
  return std::max(std::max(b[0].w, b[1].w), std::max(b[2].w, b[3].w));
}

Sphere boundingSphere(const Bezier& segment) {
  const vec3 centre = 0.5f * (vec3(segment.b[0]) + vec3(segment.b[3]));
  float reach = 0;
  for (const vec4& point : segment.b) reach = std::max(reach, glm::distance(vec3(point), centre));
  return {centre, reach + radiusBound(segment) + rounding(segment)};
}

Capsule pieceCapsule(const Bezier& segment, int level, int index) {
  assert(level >= 0 && level <= kBernsteinLevels && index >= 0 && index < (1 << level));
  const auto sample = [&segment, level](int j) {
    const vec4& w = bernsteinTable()[std::size_t(j) << (kBernsteinLevels - level)];
    return w.x * segment.b[0] + w.y * segment.b[1] + w.z * segment.b[2] + w.w * segment.b[3];
  };
  const vec4 start = sample(index), end = sample(index + 1);
  const float radius = std::min(radiusBound(segment),
                                std::max(start.w, end.w) + filipBound(filipRadiusConstant(segment), level));
  return {vec3(start), vec3(end), radius + filipBound(filipConstant(segment), level) + rounding(segment)};
}

}  // namespace vasa
