#include "curve/interpolate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/cancellation.h"
#include "curve/bspline.h"
#include "math/closest_point.h"

// With n spans, C(i) is a mean of d_i, d_{i+1}, d_{i+2}; natural ends make the first three and the last three
// points equidistant in their Greville abscissae (0, 1/3, 1). Together a tridiagonal, diagonally dominant
// system for d_1 .. d_{n+1}; d_0 and d_{n+2} are the end samples.
namespace vasa {
namespace {

constexpr int kHalvings = 8;
constexpr float kSwing = 0.5f;         // of a chord, that a control point may leave it
constexpr float kLeastRadius = 0.25f;  // of the samples around it

std::vector<vec4> solve(const std::vector<vec4>& samples) {
  const auto spans = std::uint32_t(samples.size()) - 1;
  const dvec4 first(samples.front()), last(samples.back());
  if (spans == 1) {
    const dvec4 step = (last - first) / 3.0;
    return {samples.front(), vec4(first + step), vec4(last - step), samples.back()};
  }
  const std::size_t count = spans + 1;  // unknown k is d_{k+1}
  std::vector<double> lower(count), diagonal(count), upper(count);
  std::vector<dvec4> right(count);
  diagonal.front() = diagonal.back() = 1.5;
  upper.front() = lower.back() = -0.5;
  right.front() = first, right.back() = last;
  for (std::uint32_t i = 1; i < spans; ++i) {
    const dvec4 w(deBoorWeights(i, spans, 0));
    lower[i] = w.x, diagonal[i] = w.y, upper[i] = w.z;
    right[i] = dvec4(samples[i]);
  }
  for (std::size_t k = 1; k < count; ++k) {
    const double factor = lower[k] / diagonal[k - 1];
    diagonal[k] -= factor * upper[k - 1];
    right[k] -= factor * right[k - 1];
  }
  std::vector<vec4> points(count + 2);
  points.front() = samples.front(), points.back() = samples.back();
  dvec4 next(0);
  for (std::size_t k = count; k-- > 0;) {
    next = (right[k] - (k + 1 < count ? upper[k] * next : dvec4(0))) / diagonal[k];
    points[k + 1] = vec4(next);
  }
  return points;
}

bool swings(std::span<const vec4> points, std::uint32_t span, const vec4& from, const vec4& to) {
  const float least = kLeastRadius * std::min(from.w, to.w);
  for (std::uint32_t k = span; k < span + 4; ++k)
    if (!(points[k].w > least)) return true;
  const Bezier segment = bezierOfSpan(points, span);
  const vec3 a(from), b(to);
  const float slack = kSwing * glm::distance(a, b);
  for (const vec4& p : {segment.b[1], segment.b[2]})
    if (glm::distance(vec3(p), glm::mix(a, b, closestOnSegment(vec3(p), a, b))) > slack) return true;
  return false;
}

// A short step swings out because of a long one beside it: that is the one to split.
std::vector<bool> toSplit(std::span<const vec4> points, const std::vector<vec4>& samples) {
  const auto steps = std::uint32_t(samples.size()) - 1;
  const auto length = [&](std::uint32_t i) {
    return i < steps ? glm::distance(vec3(samples[i]), vec3(samples[i + 1])) : 0.0f;
  };
  std::vector<bool> split(steps);
  for (std::uint32_t i = 0; i < steps; ++i) {
    if (!swings(points, i, samples[i], samples[i + 1])) continue;
    const float longest = std::max({length(i - 1), length(i), length(i + 1)});
    for (const std::uint32_t k : {i - 1, i, i + 1})
      if (k < steps && length(k) >= 0.5f * longest) split[k] = true;
  }
  return split;
}

// How far a sample is from the curve, in tolerances.
struct Tolerance {
  float centre, radius;
  float miss(const vec4& at, const vec4& sample) const {
    return std::max(glm::distance(vec3(at), vec3(sample)) / (centre * sample.w),
                    std::abs(at.w - sample.w) / (radius * sample.w));
  }
};

// The samples at which a polyline through them stays within the tolerance of the others (greedy, longest
// chords).
std::vector<bool> polylineCorners(std::span<const vec4> samples, const Tolerance& tolerance) {
  std::vector<bool> kept(samples.size());
  kept.front() = kept.back() = true;
  constexpr std::size_t kLongest = 64;
  const auto fits = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a + 1; i < b; ++i) {
      const float t = closestOnSegment(vec3(samples[i]), vec3(samples[a]), vec3(samples[b]));
      if (tolerance.miss(glm::mix(samples[a], samples[b], t), samples[i]) > 1) return false;
    }
    return vec3(samples[a]) != vec3(samples[b]);
  };
  for (std::size_t a = 0; a + 1 < samples.size();) {
    std::size_t b = a + 1;
    while (b + 1 < samples.size() && b - a < kLongest && fits(a, b + 1)) ++b;
    kept[b] = true;
    a = b;
  }
  return kept;
}

struct Nearest {
  float parameter, miss;
};
Nearest nearestBetween(std::span<const vec4> points, float from, float to, const vec4& sample,
                       const Tolerance& tolerance) {
  constexpr int kSteps = 8;
  const int count = int(std::ceil((to - from) * kSteps));
  Nearest best{from, tolerance.miss(evaluate(points, from), sample)};
  const auto look = [&](float u) {
    const float miss = tolerance.miss(evaluate(points, u), sample);
    if (miss < best.miss) best = {u, miss};
  };
  for (int i = 1; i <= count; ++i) look(std::min(from + float(i) / kSteps, to));
  for (float step = 0.5f / kSteps; step > 1e-3f; step *= 0.5f)
    for (const float u : {best.parameter - step, best.parameter + step}) look(std::clamp(u, from, to));
  return best;
}

}  // namespace

SampledSpline interpolateSamples(std::span<const vec4> samples) {
  assert(samples.size() >= 2);
  std::vector<vec4> dense(samples.begin(), samples.end());
  std::vector<std::uint32_t> place(samples.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  SampledSpline result;
  for (int round = 0;; ++round) {
    checkpoint();
    result.points = solve(dense);
    if (round == kHalvings) break;
    const std::vector<bool> split = toSplit(result.points, dense);
    std::vector<vec4> finer{dense.front()};
    std::vector<std::uint32_t> moved{0};
    for (std::uint32_t i = 0; i + 1 < dense.size(); ++i) {
      if (split[i]) finer.push_back(0.5f * (dense[i] + dense[i + 1]));
      finer.push_back(dense[i + 1]);
      moved.push_back(std::uint32_t(finer.size() - 1));
    }
    if (finer.size() == dense.size()) break;
    for (std::uint32_t& p : place) p = moved[p];
    dense = std::move(finer);
  }
  float least = dense.front().w;
  for (const vec4& s : dense) least = std::min(least, s.w);
  for (vec4& p : result.points) p.w = std::max(p.w, kLeastRadius * least);
  for (const std::uint32_t p : place) result.parameters.push_back(float(p));
  return result;
}

SampledSpline followSamples(std::span<const vec4> samples, float centre, float radius) {
  assert(samples.size() >= 2);
  const Tolerance tolerance{centre, radius};
  std::vector<bool> kept = polylineCorners(samples, {0.5f * centre, 0.5f * radius});
  Checkpoints checkpoints;
  for (bool missed = true; missed;) {
    std::vector<vec4> corners;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (kept[i]) corners.push_back(samples[i]);
    const SampledSpline through = interpolateSamples(corners);
    SampledSpline result{through.points, {}};
    missed = false;
    std::size_t corner = 0;
    float worst = 1;
    std::size_t worstAt = 0;
    const auto keepWorst = [&] {
      if (worst > 1) kept[worstAt] = missed = true;
      worst = 1;
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
      checkpoints.pass();
      if (i > 0 && kept[i]) ++corner, keepWorst();
      Nearest at{through.parameters[corner], 0};
      if (!kept[i])
        at = nearestBetween(through.points, at.parameter, through.parameters[corner + 1], samples[i],
                            tolerance);
      if (at.miss > worst) worst = at.miss, worstAt = i;
      result.parameters.push_back(at.parameter);
    }
    if (!missed) return result;
  }
  return {};
}

}  // namespace vasa
