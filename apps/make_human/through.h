#pragma once
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa::human {

/// A smooth curve through waypoints: the natural cubic spline on chord lengths, tabled densely.
class ThroughPoints {
 public:
  explicit ThroughPoints(std::span<const vec3> waypoints);

  /// [m] along the curve at a waypoint.
  float lengthAt(std::size_t waypoint) const { return waypointLengths_[waypoint]; }
  vec3 position(float length) const;
  vec3 tangent(float length) const;  ///< unit

 private:
  std::vector<float> waypointLengths_, lengths_;
  std::vector<vec3> samples_;
};

/// De Boor points of the clamped uniform cubic B-spline (curve/bspline.h) that passes at its knots through
/// points at equal distances, with the given unit tangents at its ends. @param points  at least 3
std::vector<vec3> interpolateAtKnots(std::span<const vec3> points, vec3 startTangent, vec3 endTangent);

}  // namespace vasa::human
