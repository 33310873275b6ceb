#pragma once
#include <span>

#include "make_human/rig.h"
#include "math/aabb.h"

namespace vasa::human {

/// A lofted part of the body: parallel cross-sections along a straight axis. A section is a superellipse with
/// its own centre, half width and half depths to the front and the back; the ends are closed by half
/// ellipsoids.
struct Part {
  struct Section {
    float u = 0, v = 0;  ///< [m] centre, from the axis, to the side and to the front
    float width = 0, front = 0, back = 0;
    float square = 2;  ///< exponent of the superellipse
  };
  std::string name;
  bool carve = false;  ///< taken away from what the parts before it make
  float blend = 0;     ///< [m] radius of the smooth union
  float cell = 0;      ///< [m] the polygons' size here
  vec3 origin{0}, axis{0, 1, 0}, side{1, 0, 0}, front{0, 0, 1};
  float length = 0;  ///< [m] 0: an ellipsoid
  float capStart = 0, capEnd = 0;
  std::vector<Section> sections;  ///< at equal steps along the axis
  std::vector<int> path;          ///< joints that move the skin here, in order along the limb
  Aabb bounds;

  /// Signed distance to first order, negative inside.
  float distance(vec3 p) const;
};

/// The body's shape: the smooth union of its parts (quadratic smooth minimum after Quilez).
struct Shape {
  std::vector<Part> parts;

  float distance(vec3 p) const;  ///< [m] negative inside; exact near the surface to first order
  vec3 gradient(vec3 p) const;
  float cellSize(vec3 p, float reach) const;  ///< [m] how fine the polygons must be within `reach` of p
  Aabb bounds() const;
};

/// Reads the parts of one mesh from parts.csv (a row a part) and sections.csv (a row a cross-section).
Result<Shape> readShape(const std::filesystem::path& parts, const std::filesystem::path& sections,
                        std::string_view mesh, const Rig& rig);

}  // namespace vasa::human
