#include "mesh/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cancellation.h"
#include "math/aabb.h"

namespace vasa {
namespace {

constexpr std::uint32_t kLeaf = 8;
constexpr float kFar = 2.3f;            // radii from a group's centre, beyond which its dipole stands for it
constexpr float kBallMargin = 1.0001f;  // of the distances by which a group is left out

}  // namespace

WindingNumber::WindingNumber(std::span<const vec3> positions, std::span<const uvec3> triangles) {
  for (const uvec3& t : triangles) triangles_.push_back({positions[t.x], positions[t.y], positions[t.z]});
  if (!triangles_.empty()) build(0, std::uint32_t(triangles_.size()));
}

// About half of the triangles on each side, along the longer side of the box around their centres.
void WindingNumber::halve(std::span<Triangle> triangles) {
  Aabb box;
  for (const auto& [a, b, c] : triangles) box.add(a + b + c);
  const int axis = box.longestAxis();
  std::ranges::nth_element(triangles, triangles.begin() + std::ptrdiff_t(triangles.size() / 2), {},
                           [&](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; });
}

void WindingNumber::build(std::uint32_t first, std::uint32_t last) {
  checkpoint();
  Node node{first, last, 0, vec3(0), 0, vec3(0)};
  float areas = 0;
  for (std::uint32_t i = first; i < last; ++i) {
    const auto& [a, b, c] = triangles_[i];
    const vec3 normal = 0.5f * glm::cross(b - a, c - a);
    const float area = glm::length(normal) + 1e-20f;
    node.dipole += normal;
    node.centre += area * (a + b + c) / 3.0f;
    areas += area;
  }
  node.centre /= areas;
  for (std::uint32_t i = first; i < last; ++i)
    for (const vec3& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c})
      node.radius = std::max(node.radius, glm::distance(corner, node.centre));
  const std::size_t own = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= kLeaf) return;
  const std::uint32_t middle = first + (last - first) / 2;
  halve(std::span(triangles_).subspan(first, last - first));
  build(first, middle);
  nodes_[own].second = std::uint32_t(nodes_.size());
  build(middle, last);
}

float WindingNumber::at(vec3 point) const {
  if (nodes_.empty()) return 0;
  float sum = 0;  // of solid angles
  std::array<std::uint32_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    const vec3 way = node.centre - point;
    const float squared = glm::dot(way, way), limit = kFar * node.radius;
    if (squared > limit * limit) {
      sum += glm::dot(node.dipole, way) / (squared * std::sqrt(squared));
    } else if (node.second > 0) {
      stack[size++] = node.second;
      stack[size++] = std::uint32_t(&node - nodes_.data()) + 1;
    } else {
      // Van Oosterom, Strackee 1983.
      for (std::uint32_t i = node.first; i < node.last; ++i) {
        const vec3 a = triangles_[i].a - point, b = triangles_[i].b - point, c = triangles_[i].c - point;
        const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const float denominator =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
      }
    }
  }
  return sum / (4 * kPi);
}

void WindingNumber::addNear(vec3 point, float reach, std::vector<Triangle>& near) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (glm::distance(node.centre, point) > (node.radius + reach) * kBallMargin) continue;
    if (node.second > 0) {
      stack[size++] = node.second;
      stack[size++] = std::uint32_t(&node - nodes_.data()) + 1;
    } else {
      near.insert(near.end(), triangles_.begin() + node.first, triangles_.begin() + node.last);
    }
  }
}

}  // namespace vasa
