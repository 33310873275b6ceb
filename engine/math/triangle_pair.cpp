#include "math/triangle_pair.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace vasa {
namespace {

struct Plane {
  vec3 normal, through;
  float side(vec3 p) const { return glm::dot(normal, p - through); }
};

Plane planeOf(const Triangle& t) { return {glm::cross(t.b - t.a, t.c - t.a), t.a}; }

// Signed distances of the corners, in lengths of the other's normal; nothing where all lie on one side.
std::optional<vec3> sides(const Plane& plane, const Triangle& t) {
  const vec3 d{plane.side(t.a), plane.side(t.b), plane.side(t.c)};
  const bool above = d.x >= 0 && d.y >= 0 && d.z >= 0, below = d.x <= 0 && d.y <= 0 && d.z <= 0;
  if (above || below) return std::nullopt;
  return d;
}

// Where the triangle cuts the line: along the two edges from the corner that lies alone on its side of the
// plane.
std::pair<float, float> interval(const Triangle& t, vec3 d, vec3 line) {
  const vec3 along{glm::dot(line, t.a), glm::dot(line, t.b), glm::dot(line, t.c)};
  const bool oneAbove = (d.x > 0) + (d.y > 0) + (d.z > 0) == 1;
  int alone = 0;
  while (oneAbove ? !(d[alone] > 0) : !(d[alone] < 0)) ++alone;
  const auto cut = [&](int other) {
    return along[alone] + (along[other] - along[alone]) * d[alone] / (d[alone] - d[other]);
  };
  return std::minmax({cut((alone + 1) % 3), cut((alone + 2) % 3)});
}

}  // namespace

bool trianglesCross(const Triangle& first, const Triangle& second) {
  const Plane p = planeOf(first), q = planeOf(second);
  const auto ofSecond = sides(p, second);
  if (!ofSecond) return false;
  const auto ofFirst = sides(q, first);
  if (!ofFirst) return false;
  const vec3 line = glm::cross(p.normal, q.normal);
  const auto [low, high] = interval(first, *ofFirst, line);
  const auto [otherLow, otherHigh] = interval(second, *ofSecond, line);
  return low < otherHigh && otherLow < high;
}

}  // namespace vasa
