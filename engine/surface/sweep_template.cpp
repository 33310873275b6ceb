#include "surface/sweep_template.h"

#include <cmath>
#include <numbers>

namespace vasa {
namespace {

vec2 unitAt(double angle) { return {float(std::cos(angle)), float(std::sin(angle))}; }

// The two triangles of the quad between place k and the next of two neighbouring rings.
void addQuad(std::vector<uvec3>& triangles, std::uint32_t ring, std::uint32_t k, std::uint32_t around) {
  const std::uint32_t next = (k + 1) % around;
  const std::uint32_t a = ring * around + k, b = ring * around + next;
  const std::uint32_t c = b + around, d = a + around;
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

}  // namespace

std::vector<vec2> ringDirections(std::uint32_t around) {
  const vec2 step = unitAt(2 * std::numbers::pi / around);
  std::vector<vec2> directions{{1, 0}};
  while (directions.size() < around) {
    const vec2 d = directions.back();
    directions.push_back({d.x * step.x - d.y * step.y, d.x * step.y + d.y * step.x});
  }
  return directions;
}

std::vector<vec2> capAngles() {
  std::vector<vec2> angles;
  for (std::uint32_t j = 0; j < shared::kCapRings; ++j)
    angles.push_back(unitAt(0.5 * std::numbers::pi * j / shared::kCapRings));
  angles.push_back({0, 1});
  return angles;
}

std::vector<uvec3> sweepTriangles(const SweepShape& shape) {
  std::vector<uvec3> triangles;
  triangles.reserve(shape.sweepTriangles());
  for (std::uint32_t ring = 0; ring < shape.along; ++ring)
    for (std::uint32_t k = 0; k < shape.around; ++k) addQuad(triangles, ring, k, shape.around);
  return triangles;
}

std::vector<uvec3> capTriangles(const SweepShape& shape) {
  std::vector<uvec3> triangles;
  triangles.reserve(shape.capTriangles());
  for (std::uint32_t ring = 0; ring + 1 < shared::kCapRings; ++ring)
    for (std::uint32_t k = 0; k < shape.around; ++k) addQuad(triangles, ring, k, shape.around);
  const std::uint32_t pole = shared::kCapRings * shape.around, top = pole - shape.around;
  for (std::uint32_t k = 0; k < shape.around; ++k)
    triangles.push_back({top + k, top + (k + 1) % shape.around, pole});
  return triangles;
}

}  // namespace vasa
