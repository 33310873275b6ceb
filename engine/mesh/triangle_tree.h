#pragma once
#include <limits>
#include <span>
#include <vector>

#include "core/ids.h"
#include "mesh/triangle_mesh.h"

namespace vasa {

/// A binary tree of boxes over a mesh's triangles: nearest points, rays and planes in O(log n) expected.
/// Built once in O(n log n); queries are const and may run on many threads. The mesh must outlive the tree
/// and not change.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Nearest {
    vec3 point{0};
    std::uint32_t triangle = kNone;  ///< none where nothing lies within the distance
    float distance = std::numeric_limits<float>::infinity();
  };
  /// The surface point nearest to p, if one is nearer than `within`.
  Nearest nearest(vec3 p, float within = std::numeric_limits<float>::infinity()) const;

  /// Whether a triangle other than `except` lies on the ray. O(log n) expected.
  bool hits(vec3 from, vec3 direction, std::uint32_t except) const;

  /// Appends the triangles that may cross the plane within `reach` of a point on it, in ascending order.
  /// Judged by their boxes: some of them do not.
  void nearPlane(vec3 onPlane, vec3 normal, float reach, std::vector<std::uint32_t>& triangles) const;

 private:
  struct Node {
    Aabb box;
    std::uint32_t first, count;  ///< a leaf's triangles in order_; count 0: children at first and first + 1
  };
  struct Placed {
    float at;  // of its box's middle, along an axis
    std::uint32_t triangle;
  };
  void split(std::uint32_t node, std::uint32_t first, std::uint32_t count, std::span<Placed> room);

  const TriangleMesh& mesh_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace vasa
