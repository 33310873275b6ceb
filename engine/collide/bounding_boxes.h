#pragma once
#include <span>

#include "math/aabb.h"

// The boxes of conventional hierarchies (collide/box_hierarchy.h): each is fitted to points, tells whether it
// meets another, gives its corners, and says along which direction what it holds is best cut in two.
namespace vasa {

/// A box along the axes: 24 bytes.
struct AlignedBox {
  vec3 low{0}, high{0};

  static AlignedBox around(std::span<const vec3> points);
  bool meets(const AlignedBox& other) const {
    return glm::all(glm::lessThanEqual(low, other.high)) && glm::all(glm::lessThanEqual(other.low, high));
  }
  void corners(std::span<vec3, 8> out) const;
  vec3 longest() const;  ///< unit
};

/// A box along the principal axes of its points (Gottschalk, Lin, Manocha 1996, "OBBTree"): 60 bytes.
struct OrientedBox {
  mat3 axes{1};  ///< unit, a column each
  vec3 centre{0};
  vec3 half{0};  ///< [m] half extents along the axes, grown by rounding

  static OrientedBox around(std::span<const vec3> points);
  /// By the 15 axes that can separate two boxes.
  bool meets(const OrientedBox& other) const;
  void corners(std::span<vec3, 8> out) const;
  vec3 longest() const;  ///< unit
};

}  // namespace vasa
