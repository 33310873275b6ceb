#include "curve/bspline.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "math/quadrature.h"

// Bézier points are values of the spline's blossom f (Ramshaw 1989): with knots clamped to [0, n],
// d_i = f(i-2, i-1, i), and over span [i, i+1]
//   b0 = f(i,i,i), b1 = f(i,i,i+1), b2 = f(i,i+1,i+1), b3 = f(i+1,i+1,i+1).
namespace vasa {
namespace {

float knot(int k, int spans) { return float(std::clamp(k, 0, spans)); }

// Rows of the four Bézier points as combinations of d_i .. d_{i+3}.
struct Rows {
  vec4 b0, b1, b2, b3;
};

Rows computeRows(int i, int n) {
  const float before2 = knot(i - 2, n), before1 = knot(i - 1, n), start = float(i), end = float(i + 1);
  const float after1 = knot(i + 2, n), after2 = knot(i + 3, n);
  const vec4 d0(1, 0, 0, 0), d1(0, 1, 0, 0), d2(0, 0, 1, 0), d3(0, 0, 0, 1);
  const auto between = [](const vec4& low, const vec4& high, float a, float b, float at) {
    return glm::mix(low, high, (at - a) / (b - a));
  };
  Rows rows;
  rows.b1 = between(d1, d2, before1, after1, start);
  rows.b2 = between(d1, d2, before1, after1, end);
  const vec4 enter = between(d0, d1, before2, end, start);  // f(i-1, i, i)
  rows.b0 = between(enter, rows.b1, before1, end, start);
  const vec4 leave = between(d2, d3, start, after2, end);  // f(i+1, i+1, i+2)
  rows.b3 = between(rows.b2, leave, start, after1, end);
  return rows;
}

// They depend on how near the ends are, no farther than two spans, and on nothing else; to the last bit.
constexpr int kNear = 2;
const auto kRows = [] {
  std::array<std::array<Rows, kNear + 1>, kNear + 1> table{};
  for (int before = 0; before <= kNear; ++before)
    for (int behind = 0; behind <= kNear; ++behind)
      table[before][behind] = computeRows(before, before + 1 + behind);
  return table;
}();

const Rows& bezierRows(int i, int n) { return kRows[std::min(i, kNear)][std::min(n - 1 - i, kNear)]; }

Bezier combined(const Rows& rows, std::span<const vec4, 4> d) {
  const auto combine = [d](const vec4& w) { return w.x * d[0] + w.y * d[1] + w.z * d[2] + w.w * d[3]; };
  return {{combine(rows.b0), combine(rows.b1), combine(rows.b2), combine(rows.b3)}};
}

}  // namespace

mat4 spanToBezier(std::uint32_t span, std::uint32_t spans) {
  const Rows& rows = bezierRows(int(span), int(spans));
  return glm::transpose(mat4(rows.b0, rows.b1, rows.b2, rows.b3));
}

Bezier bezierOfSpan(std::span<const vec4> points, std::uint32_t span) {
  assert(points.size() >= kMinPoints && span < spanCount(points));
  return combined(bezierRows(int(span), int(spanCount(points))), points.subspan(span).first<4>());
}

SpanParameter locate(float u, std::uint32_t spans) {
  const float clamped = std::clamp(u, 0.0f, float(spans));
  const std::uint32_t span = std::min(std::uint32_t(clamped), spans - 1);
  return {span, clamped - float(span)};
}

vec4 evaluate(std::span<const vec4> points, float u) {
  const auto [span, t] = locate(u, spanCount(points));
  return bezierOfSpan(points, span).at(t);
}

vec4 evaluateDerivative(std::span<const vec4> points, float u) {
  const auto [span, t] = locate(u, spanCount(points));
  return bezierOfSpan(points, span).derivative(t);
}

vec4 deBoorWeights(std::uint32_t span, std::uint32_t spans, float t) {
  const Rows& rows = bezierRows(int(span), int(spans));
  const vec4 w = bernstein(t);
  return w.x * rows.b0 + w.y * rows.b1 + w.z * rows.b2 + w.w * rows.b3;
}

float lengthOf(std::span<const vec4> points) {
  double sum = 0;
  for (std::uint32_t i = 0; i < spanCount(points); ++i) {
    const Bezier segment = bezierOfSpan(points, i);
    for (const auto& [t, weight] : kGauss4) sum += weight * glm::length(vec3(segment.derivative(t)));
  }
  return float(sum);
}

// From each span's first point: coordinates of a metre would round by more than a thousandth of a short span.
float volumeOf(std::span<const vec4> points) {
  double sum = 0;
  for (std::uint32_t i = 0; i < spanCount(points); ++i) {
    const vec4 origin(vec3(points[i]), 0);
    const std::array<vec4, 4> own{points[i] - origin, points[i + 1] - origin, points[i + 2] - origin,
                                  points[i + 3] - origin};
    const Bezier segment = combined(bezierRows(int(i), int(spanCount(points))), own);
    for (const auto& [t, weight] : kGauss4) {
      const float r = segment.at(t).w;
      sum += weight * kPi * r * r * glm::length(vec3(segment.derivative(t)));
    }
  }
  return float(sum);
}

}  // namespace vasa
