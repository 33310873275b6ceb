#pragma once
#include <cstdint>
#include <span>

#include "curve/bezier.h"

// A vessel's shape: a cubic B-spline in (x, y, z, r) on clamped uniform knots
//   0 0 0 0 1 2 ... n-1 n n n n      (n spans, n + 3 de Boor points, parameter u in [0, n]).
// The knots follow from the number of points, so 16 bytes a point is all that is stored; the curve
// starts at the first point and ends at the last, is C² inside, and each span lies in the convex hull
// of its four points. All functions take the de Boor points of one vessel, at least four.
namespace vasa {

constexpr std::uint32_t kMinPoints = 4;

inline std::uint32_t spanCount(std::span<const vec4> points) { return std::uint32_t(points.size()) - 3; }

/// The matrix M (column major, b = M · d) that takes the de Boor points d of span i of n to Bézier
/// points. Spans near the ends differ from inner ones. Every entry is in [0, 1], every row sums to 1.
mat4 spanToBezier(std::uint32_t span, std::uint32_t spans);

/// Bézier points of one span.
Bezier bezierOfSpan(std::span<const vec4> points, std::uint32_t span);

/// Span and local parameter of u, clamped to the spline.
struct SpanParameter {
  std::uint32_t span;
  float t;
};
SpanParameter locate(float u, std::uint32_t spans);

vec4 evaluate(std::span<const vec4> points, float u);
vec4 evaluateDerivative(std::span<const vec4> points, float u);  ///< d/du

/// The weights of the four de Boor points span .. span+3 at local parameter t: C = Σ w_l d_{span+l}.
vec4 deBoorWeights(std::uint32_t span, std::uint32_t spans, float t);

/// Arc length of the centre line [m], 4-point Gauss a span.
float lengthOf(std::span<const vec4> points);
/// Enclosed volume ∫ π r² |C'| du [m³], 4-point Gauss a span (paper §3.2, with n along C').
float volumeOf(std::span<const vec4> points);

}  // namespace vasa
