#pragma once
#include <limits>

#include "math/types.h"

namespace vasa {

/// Where two segments come nearest: points p0 + s (p1 - p0) and q0 + t (q1 - q0), and the distance between
/// them.
template <class Real>
struct SegmentClosest {
  Real s, t;  ///< in [0, 1]
  Real distance;
};

/// Nearest points of the segments p0 p1 and q0 q1, either of which may be a point.
/// Method: the inner stationary point (Ericson 2005, 5.1.9) against the four end-to-segment distances, so
/// that near-parallel segments, where the inner system is singular, still have an exact answer. The distance
/// belongs to the returned parameters, so it is never too small; squared, it is too large by no more than a
/// few rounding errors of the squared lengths. Whoever needs a lower bound subtracts that (kSegmentSlack
/// times the sum of the squared lengths and the squared gap between the starts).
SegmentClosest<float> closestOnSegments(vec3 p0, vec3 p1, vec3 q0, vec3 q1);
SegmentClosest<double> closestOnSegments(dvec3 p0, dvec3 p1, dvec3 q0, dvec3 q1);

/// Relative slack of a squared distance, in single and double precision: 32 rounding errors.
template <class Real>
constexpr Real kSegmentSlack = Real(16) * std::numeric_limits<Real>::epsilon();

}  // namespace vasa
