#pragma once
#include <array>
#include <utility>

#include "math/aabb.h"

namespace vasa {

/// One cubic Bézier segment of a sweep: control points (x, y, z, r), metres. Parameter t in [0, 1].
struct Bezier {
  std::array<vec4, 4> b;

  vec4 at(float t) const;
  vec4 derivative(float t) const;        ///< d/dt
  vec4 secondDerivative(float t) const;  ///< d²/dt²
  float curvature(float t) const;        ///< [1/m] of the centre line; 0 where that stands still
  /// The parts before and after t (de Casteljau).
  std::pair<Bezier, Bezier> split(float t) const;
  /// The parameter of the point on the centre line nearest to p: the best of nine samples, then three Newton
  /// steps on the squared distance. Right unless the line comes about as near twice.
  float nearest(vec3 p) const;
  /// Box that holds the whole tube: hull of the control points grown by their radii.
  Aabb bounds() const;
};

/// The four Bernstein polynomials of degree 3 at t.
inline vec4 bernstein(float t) {
  const float s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// Their derivatives at t.
inline vec4 bernsteinDerivative(float t) {
  const float s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

/// Bernstein values at j / 2^10, shared by everything that descends a segment by halving (paper §4).
constexpr int kBernsteinLevels = 10;
const std::array<vec4, (1 << kBernsteinLevels) + 1>& bernsteinTable();

}  // namespace vasa
