#include "math/segment_distance.h"

// The squared distance is a convex quadratic of (s, t) on the unit square, so its minimum is either the inner
// stationary point or lies on one of the square's four sides, each of which is an end-to-segment problem
// without cancellation. Where the inner system is close to singular its solution is uncertain along the
// valley; t is then recomputed as the best partner of s, and the sides bound the loss.
namespace vasa {
namespace {

template <class Real>
Real unit(Real value) {
  return value < 0 ? Real(0) : value > 1 ? Real(1) : value;
}

template <class Real, class Vector>
SegmentClosest<Real> closest(Vector p0, Vector p1, Vector q0, Vector q1) {
  const Vector u = p1 - p0, v = q1 - q0, w = p0 - q0;
  const Real uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v), uw = glm::dot(u, w),
             vw = glm::dot(v, w);
  const auto bestS = [&](Real t) { return uu > 0 ? unit((t * uv - uw) / uu) : Real(0); };
  const auto bestT = [&](Real s) { return vv > 0 ? unit((s * uv + vw) / vv) : Real(0); };
  SegmentClosest<Real> best{0, 0, -1};
  const auto consider = [&](Real s, Real t) {
    const Vector gap = w + s * u - t * v;
    const Real squared = glm::dot(gap, gap);
    if (best.distance < 0 || squared < best.distance) best = {s, t, squared};
  };
  const Real determinant = uu * vv - uv * uv;
  if (determinant > 0) {
    const Real s = unit((uv * vw - vv * uw) / determinant);
    const Real t = bestT(s);
    consider(bestS(t), t);
  }
  consider(0, bestT(0));
  consider(1, bestT(1));
  consider(bestS(0), 0);
  consider(bestS(1), 1);
  best.distance = std::sqrt(best.distance);
  return best;
}

}  // namespace

SegmentClosest<float> closestOnSegments(vec3 p0, vec3 p1, vec3 q0, vec3 q1) {
  return closest<float>(p0, p1, q0, q1);
}
SegmentClosest<double> closestOnSegments(dvec3 p0, dvec3 p1, dvec3 q0, dvec3 q1) {
  return closest<double>(p0, p1, q0, q1);
}

}  // namespace vasa
