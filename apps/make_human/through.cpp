#include "make_human/through.h"

#include <algorithm>
#include <cassert>

#include "curve/bspline.h"

namespace vasa::human {
namespace {

constexpr int kSamplesPerSpan = 48;

/// Solves a tridiagonal system with vector right-hand sides (Thomas). a: below, b: on, c: above the diagonal.
std::vector<dvec3> solveTridiagonal(std::vector<double> a, std::vector<double> b, std::vector<double> c,
                                    std::vector<dvec3> d) {
  const std::size_t n = b.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = a[i] / b[i - 1];
    b[i] -= factor * c[i - 1];
    d[i] -= factor * d[i - 1];
  }
  d[n - 1] /= b[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) d[i] = (d[i] - c[i] * d[i + 1]) / b[i];
  return d;
}

/// Second derivatives at the waypoints of the natural cubic spline with the given parameters.
std::vector<dvec3> naturalCurvature(std::span<const vec3> p, const std::vector<double>& at) {
  const std::size_t n = p.size();
  std::vector<double> a(n, 0), b(n, 1), c(n, 0);
  std::vector<dvec3> d(n, dvec3(0));
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = at[i] - at[i - 1], after = at[i + 1] - at[i];
    a[i] = before / 6;
    b[i] = (before + after) / 3;
    c[i] = after / 6;
    d[i] = (dvec3(p[i + 1]) - dvec3(p[i])) / after - (dvec3(p[i]) - dvec3(p[i - 1])) / before;
  }
  return solveTridiagonal(a, b, c, d);
}

}  // namespace

ThroughPoints::ThroughPoints(std::span<const vec3> p) {
  assert(p.size() >= 2);
  std::vector<double> at{0};
  for (std::size_t i = 1; i < p.size(); ++i) at.push_back(at.back() + double(glm::distance(p[i], p[i - 1])));
  const std::vector<dvec3> bend = naturalCurvature(p, at);
  double length = 0;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    waypointLengths_.push_back(float(length));
    const double step = at[i + 1] - at[i];
    for (int k = i == 0 ? 0 : 1; k <= kSamplesPerSpan; ++k) {
      const double t = double(k) / kSamplesPerSpan, s = 1 - t;
      const dvec3 point = s * dvec3(p[i]) + t * dvec3(p[i + 1]) +
                          step * step / 6 * ((s * s * s - s) * bend[i] + (t * t * t - t) * bend[i + 1]);
      if (!samples_.empty()) length += glm::distance(point, dvec3(samples_.back()));
      samples_.push_back(vec3(point));
      lengths_.push_back(float(length));
    }
  }
  waypointLengths_.push_back(float(length));
}

vec3 ThroughPoints::position(float length) const {
  const auto above = std::lower_bound(lengths_.begin() + 1, lengths_.end() - 1, length);
  const std::size_t i = std::size_t(above - lengths_.begin());
  const float step = lengths_[i] - lengths_[i - 1];
  const float t = step > 0 ? std::clamp((length - lengths_[i - 1]) / step, 0.0f, 1.0f) : 0.0f;
  return glm::mix(samples_[i - 1], samples_[i], t);
}

vec3 ThroughPoints::tangent(float length) const {
  const float h = 0.002f * lengths_.back();
  return glm::normalize(position(std::min(length + h, lengths_.back())) -
                        position(std::max(length - h, 0.0f)));
}

std::vector<vec3> interpolateAtKnots(std::span<const vec3> p, vec3 startTangent, vec3 endTangent) {
  assert(p.size() >= 3);
  const std::uint32_t spans = std::uint32_t(p.size() - 1);
  float length = 0;
  for (std::size_t i = 1; i < p.size(); ++i) length += glm::distance(p[i], p[i - 1]);
  const float third = length / float(spans) / 3;  // the curve's first derivative at an end is 3 (d1 - d0)
  std::vector<vec3> d(p.size() + 2);
  d[0] = p.front();
  d[1] = p.front() + third * startTangent;
  d[d.size() - 2] = p.back() - third * endTangent;
  d[d.size() - 1] = p.back();
  // Unknown d[2] .. d[n]: one row for each inner knot.
  const std::size_t unknowns = spans - 1;
  std::vector<double> a(unknowns), b(unknowns), c(unknowns);
  std::vector<dvec3> right(unknowns);
  for (std::size_t k = 0; k < unknowns; ++k) {
    const vec4 weights = deBoorWeights(std::uint32_t(k + 1), spans, 0);  // of d[k+1] .. d[k+4]; the last is 0
    a[k] = double(weights.x);
    b[k] = double(weights.y);
    c[k] = double(weights.z);
    right[k] = dvec3(p[k + 1]);
    if (k == 0) right[k] -= a[k] * dvec3(d[1]);
    if (k + 1 == unknowns) right[k] -= c[k] * dvec3(d[d.size() - 2]);
  }
  const std::vector<dvec3> solved = solveTridiagonal(a, b, c, right);
  for (std::size_t k = 0; k < unknowns; ++k) d[k + 2] = vec3(solved[k]);
  return d;
}

}  // namespace vasa::human
