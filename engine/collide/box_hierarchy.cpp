#include "collide/box_hierarchy.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "math/triangle_pair.h"

// A part with `count` items of `leaves` triangles each has 2 · count · leaves - 1 boxes in one run: its own,
// those of its left half, those of its right half. The left half has count / 2 items.
namespace vasa {

template <class Box>
BoxHierarchy<Box>::BoxHierarchy(const TubeSurface& surface, std::span<const vec3> positions,
                                const Exclusions& exclusions)
    : surface_(surface), exclusions_(exclusions), tubes_(exclusions.tubeCount()) {
  const std::uint32_t count = exclusions.tubeCount(), each = surface.trianglesPerTube();
  assert(positions.size() == std::size_t(count) * surface.verticesPerTube());
  std::iota(tubes_.begin(), tubes_.end(), 0u);
  if (count == 0) return;
  std::vector<vec3> middles(count, vec3(0));
  for (std::size_t v = 0; v < positions.size(); ++v) middles[v / surface.verticesPerTube()] += positions[v];
  for (vec3& middle : middles) middle /= float(surface.verticesPerTube());
  split(tubes_, [&](std::uint32_t tube) { return middles[tube]; });
  triangles_.resize(std::size_t(count) * each);
  for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
    const std::span triangles = std::span(triangles_).subspan(std::size_t(leaf) * each, each);
    std::iota(triangles.begin(), triangles.end(), 0u);
    split(triangles, [&](std::uint32_t triangle) {
      const uvec3 v = surface.triangle(tubes_[leaf], triangle);
      return (positions[v.x] + positions[v.y] + positions[v.z]) / 3.0f;
    });
  }
  boxes_.resize(2 * triangles_.size() - 1);
  refit(positions);
}

template <class Box>
template <class Centre>
void BoxHierarchy<Box>::split(std::span<std::uint32_t> items, const Centre& centreOf) {
  if (items.size() < 2) return;
  scratch_.clear();
  for (const std::uint32_t item : items) scratch_.push_back(centreOf(item));
  const vec3 direction = Box::around(scratch_).longest();
  const std::size_t half = items.size() / 2;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const float along = glm::dot(direction, centreOf(a)), other = glm::dot(direction, centreOf(b));
    return along != other ? along < other : a < b;
  };
  std::nth_element(items.begin(), items.begin() + std::ptrdiff_t(half), items.end(), before);
  split(items.first(half), centreOf);
  split(items.subspan(half), centreOf);
}

template <class Box>
auto BoxHierarchy<Box>::leftOf(const Part& part, std::uint32_t) const -> Part {
  return {part.box + 1, part.first, part.count / 2};
}

template <class Box>
auto BoxHierarchy<Box>::rightOf(const Part& part, std::uint32_t leaves) const -> Part {
  const std::uint32_t left = part.count / 2;
  return {part.box + 2 * left * leaves, part.first + left, part.count - left};
}

template <class Box>
auto BoxHierarchy<Box>::trianglesOf(const Part& tube) const -> Part {
  const std::uint32_t each = surface_.trianglesPerTube();
  return {tube.box, tube.first * each, each};
}

template <class Box>
void BoxHierarchy<Box>::refit(std::span<const vec3> positions) {
  positions_ = positions;
  if (!tubes_.empty()) fitTubes({0, 0, std::uint32_t(tubes_.size())});
}

template <class Box>
void BoxHierarchy<Box>::fitTubes(const Part& part) {
  if (part.count == 1) return fitTriangles(trianglesOf(part), tubes_[part.first]);
  const std::uint32_t each = surface_.trianglesPerTube();
  const Part left = leftOf(part, each), right = rightOf(part, each);
  fitTubes(left);
  fitTubes(right);
  std::array<vec3, 16> corners;
  boxes_[left.box].corners(std::span(corners).template first<8>());
  boxes_[right.box].corners(std::span(corners).template last<8>());
  boxes_[part.box] = Box::around(corners);
}

template <class Box>
void BoxHierarchy<Box>::fitTriangles(const Part& part, std::uint32_t tube) {
  scratch_.clear();
  for (std::uint32_t leaf = part.first; leaf < part.first + part.count; ++leaf) {
    const uvec3 v = surface_.triangle(tube, triangles_[leaf]);
    for (int k = 0; k < 3; ++k) scratch_.push_back(positions_[v[k]]);
  }
  boxes_[part.box] = Box::around(scratch_);
  if (part.count == 1) return;
  fitTriangles(leftOf(part, 1), tube);
  fitTriangles(rightOf(part, 1), tube);
}

template <class Box>
std::span<const TubePair> BoxHierarchy<Box>::detect() {
  pairs_.clear();
  if (!tubes_.empty()) meetSelf({0, 0, std::uint32_t(tubes_.size())});
  std::ranges::sort(pairs_);
  return pairs_;
}

template <class Box>
void BoxHierarchy<Box>::meetSelf(const Part& part) {
  if (part.count == 1) return;
  const std::uint32_t each = surface_.trianglesPerTube();
  const Part left = leftOf(part, each), right = rightOf(part, each);
  meetSelf(left);
  meetSelf(right);
  meetTubes(left, right);
}

template <class Box>
void BoxHierarchy<Box>::meetTubes(const Part& a, const Part& b) {
  if (!boxes_[a.box].meets(boxes_[b.box])) return;
  if (a.count == 1 && b.count == 1) {
    const std::uint32_t i = tubes_[a.first], j = tubes_[b.first];
    if (!exclusions_.contains(i, j) && meetTriangles(trianglesOf(a), i, trianglesOf(b), j))
      pairs_.push_back(orderedPair(i, j));
    return;
  }
  const std::uint32_t each = surface_.trianglesPerTube();
  if (a.count >= b.count) {
    meetTubes(leftOf(a, each), b);
    meetTubes(rightOf(a, each), b);
  } else {
    meetTubes(a, leftOf(b, each));
    meetTubes(a, rightOf(b, each));
  }
}

template <class Box>
bool BoxHierarchy<Box>::meetTriangles(const Part& a, std::uint32_t tubeA, const Part& b,
                                      std::uint32_t tubeB) const {
  if (!boxes_[a.box].meets(boxes_[b.box])) return false;
  if (a.count == 1 && b.count == 1) return cross(tubeA, triangles_[a.first], tubeB, triangles_[b.first]);
  if (a.count >= b.count)
    return meetTriangles(leftOf(a, 1), tubeA, b, tubeB) || meetTriangles(rightOf(a, 1), tubeA, b, tubeB);
  return meetTriangles(a, tubeA, leftOf(b, 1), tubeB) || meetTriangles(a, tubeA, rightOf(b, 1), tubeB);
}

template <class Box>
bool BoxHierarchy<Box>::cross(std::uint32_t tubeA, std::uint32_t a, std::uint32_t tubeB,
                              std::uint32_t b) const {
  const uvec3 u = surface_.triangle(tubeA, a), v = surface_.triangle(tubeB, b);
  return trianglesCross({positions_[u.x], positions_[u.y], positions_[u.z]},
                        {positions_[v.x], positions_[v.y], positions_[v.z]});
}

template class BoxHierarchy<AlignedBox>;
template class BoxHierarchy<OrientedBox>;

}  // namespace vasa
