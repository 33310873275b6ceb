#include "make_human/shape.h"

#include <algorithm>
#include <cmath>

#include "make_human/smooth_union.h"

// Distance to a superellipse with half axes a, b and exponent n, lofted and capped: with
//   rho = (|u/a|^n + |v/b|^n)^(1/n),  k = sqrt(rho² + (e/c)²),  e the excess over the part's ends,
// the surface is k = 1 and (k - 1) / |grad k| is the distance to first order.
namespace vasa::human {
namespace {

Part::Section mix(const Part::Section& a, const Part::Section& b, float t) {
  const auto line = [t](float x, float y) { return x + t * (y - x); };
  return {line(a.u, b.u),         line(a.v, b.v),       line(a.width, b.width),
          line(a.front, b.front), line(a.back, b.back), line(a.square, b.square)};
}

}  // namespace

float Part::distance(vec3 p) const {
  const vec3 q = p - origin;
  const float h = glm::dot(q, axis);
  const float inside = std::clamp(h, 0.0f, length);
  const float position = length > 0 ? inside / length * float(sections.size() - 1) : 0.0f;
  const std::size_t i = std::min(std::size_t(position), sections.size() - 1);
  const Section s = mix(sections[i], sections[std::min(i + 1, sections.size() - 1)], position - float(i));
  const float u = glm::dot(q, side) - s.u, v = glm::dot(q, front) - s.v, e = h - inside;
  const float depth = v > 0 ? s.front : s.back, cap = e > 0 ? capEnd : capStart;
  const float x = std::abs(u) / s.width, y = std::abs(v) / depth, z = std::abs(e) / cap;
  const bool round = s.square == 2;  // most parts, and much faster
  const float sum = round ? x * x + y * y : std::pow(x, s.square) + std::pow(y, s.square);
  const float rho = round ? std::sqrt(sum) : std::pow(sum, 1 / s.square);
  const float k = std::sqrt(rho * rho + z * z);
  if (k < 1e-4f) return -std::min(s.width, depth);
  vec3 slope{0, 0, z / cap / k};
  if (sum > 0) {
    const float outer = rho / sum * rho / k;
    slope.x = outer * (round ? x : std::pow(x, s.square - 1)) / s.width;
    slope.y = outer * (round ? y : std::pow(y, s.square - 1)) / depth;
  }
  return (k - 1) / glm::length(slope);
}

float Shape::distance(vec3 p) const { return unionDistance(parts, p, false); }
vec3 Shape::gradient(vec3 p) const { return slopeOf(*this, p); }
float Shape::cellSize(vec3 p, float reach) const { return unionCellSize(parts, p, reach); }
Aabb Shape::bounds() const { return unionBounds(parts); }

}  // namespace vasa::human
