#include "convert/tube_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cancellation.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr std::uint32_t kLeafPieces = 4;

float distanceOutside(const Aabb& box, vec3 p) {
  return glm::length(glm::max(glm::max(box.low - p, p - box.high), vec3(0)));
}

// Distance to the wall of the cone through two sections, taken across the axis at the nearest axis point.
float wallDistance(const TubePiece& piece, vec3 p, float& radius) {
  const vec3 a(piece.a), b(piece.b);
  const float t = closestOnSegment(p, a, b);
  radius = piece.a.w + t * (piece.b.w - piece.a.w);
  return glm::distance(p, a + t * (b - a)) - radius;
}

}  // namespace

void appendPieces(std::span<const vec4> points, std::uint32_t vessel, std::vector<TubePiece>& pieces) {
  for (std::uint32_t span = 0; span < spanCount(points); ++span) {
    const Bezier curve = bezierOfSpan(points, span);
    vec4 previous = curve.b[0];
    for (int i = 1; i <= kPiecesPerSpan; ++i) {
      const vec4 next = i == kPiecesPerSpan ? curve.b[3] : curve.at(float(i) / kPiecesPerSpan);
      pieces.push_back({previous, next, vessel});
      previous = next;
    }
  }
}

TubeTree::TubeTree(std::vector<TubePiece> pieces) : pieces_(std::move(pieces)) {
  if (!pieces_.empty()) build(0, std::uint32_t(pieces_.size()));
}

void TubeTree::build(std::uint32_t first, std::uint32_t count) {
  checkpoint();
  const std::size_t self = branches_.size();
  branches_.emplace_back();
  const auto begin = pieces_.begin() + first, end = begin + count;
  Aabb box, centres;
  for (auto piece = begin; piece != end; ++piece) {
    box.add(vec3(piece->a), piece->a.w), box.add(vec3(piece->b), piece->b.w);
    centres.add(vec3(piece->a) + vec3(piece->b));
  }
  branches_[self] = {box, first, count};
  if (count <= kLeafPieces) return;
  const vec3 extent = centres.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::nth_element(begin, begin + count / 2, end, [axis](const TubePiece& x, const TubePiece& y) {
    return x.a[axis] + x.b[axis] < y.a[axis] + y.b[axis];
  });
  build(first, count / 2);
  branches_[self].first = std::uint32_t(branches_.size());
  branches_[self].count = 0;
  build(first + count / 2, count - count / 2);
}

TubeTree::Hit TubeTree::nearestWall(vec3 p, float limit) const {
  Hit best{limit, 0, kNone};
  if (pieces_.empty()) return best;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth) {
    const std::uint32_t index = stack[--depth];
    const Branch& branch = branches_[index];
    if (distanceOutside(branch.box, p) >= std::abs(best.distance)) continue;
    for (std::uint32_t i = 0; i < branch.count; ++i) {
      const TubePiece& piece = pieces_[branch.first + i];
      float radius;
      const float distance = wallDistance(piece, p, radius);
      if (std::abs(distance) < std::abs(best.distance)) best = {distance, radius, piece.vessel};
    }
    if (branch.count) continue;
    std::uint32_t near = index + 1, far = branch.first;
    if (distanceOutside(branches_[far].box, p) < distanceOutside(branches_[near].box, p))
      std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

bool TubeTree::insideAnother(vec3 p, std::uint32_t own, float margin) const {
  if (pieces_.empty()) return false;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth) {
    const std::uint32_t index = stack[--depth];
    const Branch& branch = branches_[index];
    if (distanceOutside(branch.box, p) > 0) continue;
    for (std::uint32_t i = 0; i < branch.count; ++i) {
      const TubePiece& piece = pieces_[branch.first + i];
      float radius;
      if (piece.vessel != own && wallDistance(piece, p, radius) < -margin) return true;
    }
    if (branch.count) continue;
    stack[depth++] = branch.first;
    stack[depth++] = index + 1;
  }
  return false;
}

}  // namespace vasa
