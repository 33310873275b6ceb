#pragma once
#include <limits>

#include "math/types.h"

namespace vasa {

/// Axis-aligned box; empty until something is added.
struct Aabb {
  vec3 low{std::numeric_limits<float>::infinity()};
  vec3 high{-std::numeric_limits<float>::infinity()};

  bool empty() const { return low.x > high.x; }
  vec3 centre() const { return 0.5f * (low + high); }
  vec3 extent() const { return high - low; }
  /// The largest extent; 0 where it is empty.
  float size() const { return empty() ? 0 : glm::max(glm::max(extent().x, extent().y), extent().z); }
  /// The axis along which it is longest, the first of several.
  int longestAxis() const {
    const vec3 along = extent();
    return along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
  }
  void add(vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(vec3 centre, float radius) {
    low = glm::min(low, centre - radius);
    high = glm::max(high, centre + radius);
  }
  void add(const Aabb& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  /// From a place to the box; zero inside.
  float distance(vec3 p) const { return glm::length(glm::max(glm::max(low - p, p - high), vec3(0))); }
  bool overlaps(const Aabb& other) const {
    return glm::all(glm::lessThanEqual(low, other.high)) && glm::all(glm::lessThanEqual(other.low, high));
  }
};

}  // namespace vasa
