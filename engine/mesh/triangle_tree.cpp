#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/cancellation.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr float kSurelyFarther = 1.0001f;  // whatever rounding does to a box's distance and a triangle's

// Whether the half line enters the box (slabs; a direction's zeros give infinities, which compare rightly).
bool enters(const Aabb& box, vec3 from, vec3 inverse) {
  const vec3 a = (box.low - from) * inverse, b = (box.high - from) * inverse;
  const vec3 near = glm::min(a, b), far = glm::max(a, b);
  const float in = std::max({near.x, near.y, near.z, 0.0f}), out = std::min({far.x, far.y, far.z});
  return in <= out * 1.00001f;
}

// Möller and Trumbore 1997, both faces.
bool crosses(vec3 from, vec3 direction, vec3 a, vec3 b, vec3 c) {
  const vec3 ab = b - a, ac = c - a, across = glm::cross(direction, ac);
  const float determinant = glm::dot(ab, across);
  if (determinant == 0) return false;
  const float u = glm::dot(from - a, across) / determinant;
  if (!(u >= 0 && u <= 1)) return false;
  const vec3 around = glm::cross(from - a, ab);
  const float v = glm::dot(direction, around) / determinant;
  return v >= 0 && u + v <= 1 && glm::dot(ac, around) / determinant > 0;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  boxes_.reserve(mesh.triangles.size());
  for (const uvec3& t : mesh.triangles) {
    Aabb& box = boxes_.emplace_back();
    for (int k = 0; k < 3; ++k) box.add(mesh.positions[t[k]]);
  }
  std::iota(order_.begin(), order_.end(), 0u);
  if (order_.empty()) return;
  nodes_.reserve(order_.size());
  nodes_.emplace_back();
  std::vector<Placed> room(order_.size());
  split(0, 0, std::uint32_t(order_.size()), room);
}

void TriangleTree::split(std::uint32_t node, std::uint32_t first, std::uint32_t count,
                         std::span<Placed> room) {
  checkpoint();
  Aabb box, centres;
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.add(boxes_[order_[i]]);
    centres.add(boxes_[order_[i]].centre());
  }
  nodes_[node] = {box, first, count};
  if (count <= kLeafSize) return;
  const int axis = centres.longestAxis();
  const std::uint32_t half = count / 2;
  const std::span<Placed> own = room.subspan(first, count);
  for (std::uint32_t i = 0; i < count; ++i)
    own[i] = {boxes_[order_[first + i]].centre()[axis], order_[first + i]};
  std::nth_element(own.begin(), own.begin() + half, own.end(), [](const Placed& a, const Placed& b) {
    return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
  });
  for (std::uint32_t i = 0; i < count; ++i) order_[first + i] = own[i].triangle;
  const auto children = std::uint32_t(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  split(children, first, half, room);
  split(children + 1, first + half, count - half, room);
}

TriangleTree::Nearest TriangleTree::nearest(vec3 p, float within) const {
  Nearest best;
  best.distance = within;
  if (nodes_.empty()) return best;
  struct Open {
    std::uint32_t node;
    float distance;  // of its box
  };
  Open stack[64];
  int depth = 0;
  stack[depth++] = {0, nodes_.front().box.distance(p)};
  while (depth > 0) {
    const Open open = stack[--depth];
    if (open.distance >= best.distance) continue;
    const Node& node = nodes_[open.node];
    if (node.count == 0) {
      const Open left{node.first, nodes_[node.first].box.distance(p)};
      const Open right{node.first + 1, nodes_[node.first + 1].box.distance(p)};
      const bool leftNearer = left.distance <= right.distance;
      stack[depth++] = leftNearer ? right : left;
      stack[depth++] = leftNearer ? left : right;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (boxes_[order_[i]].distance(p) > kSurelyFarther * best.distance) continue;
      const uvec3& t = mesh_.triangles[order_[i]];
      const vec3 q =
          closestOnTriangle(p, mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]).point;
      const float distance = glm::distance(p, q);
      if (distance < best.distance) best = {q, order_[i], distance};
    }
  }
  return best;
}

bool TriangleTree::hits(vec3 from, vec3 direction, std::uint32_t except) const {
  if (nodes_.empty()) return false;
  const vec3 inverse = 1.0f / direction;
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!enters(node.box, from, inverse)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const uvec3& t = mesh_.triangles[order_[i]];
      if (order_[i] != except &&
          crosses(from, direction, mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]))
        return true;
    }
  }
  return false;
}

void TriangleTree::nearPlane(vec3 onPlane, vec3 normal, float reach,
                             std::vector<std::uint32_t>& triangles) const {
  if (nodes_.empty()) return;
  const std::size_t before = triangles.size();
  const auto crosses = [&](const Aabb& box) {
    if (box.distance(onPlane) > reach) return false;
    const float half = 0.5f * glm::dot(box.extent(), glm::abs(normal));
    return std::abs(glm::dot(box.centre() - onPlane, normal)) <= half * 1.0001f + 1e-7f;
  };
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!crosses(node.box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (crosses(boxes_[order_[i]])) triangles.push_back(order_[i]);
  }
  std::sort(triangles.begin() + std::ptrdiff_t(before), triangles.end());
}

}  // namespace vasa
