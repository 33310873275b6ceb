#include "curve/bezier.h"

#include <algorithm>
#include <limits>

namespace vasa {

vec4 Bezier::at(float t) const {
  const vec4 w = bernstein(t);
  return w.x * b[0] + w.y * b[1] + w.z * b[2] + w.w * b[3];
}

vec4 Bezier::derivative(float t) const {
  const float s = 1 - t;
  return 3.0f * (s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
}

vec4 Bezier::secondDerivative(float t) const {
  return 6.0f * ((1 - t) * (b[0] - 2.0f * b[1] + b[2]) + t * (b[1] - 2.0f * b[2] + b[3]));
}

float Bezier::curvature(float t) const {
  const vec3 first(derivative(t)), second(secondDerivative(t));
  const float speed = glm::length(first);
  return speed > 1e-9f ? glm::length(glm::cross(first, second)) / (speed * speed * speed) : 0;
}

std::pair<Bezier, Bezier> Bezier::split(float t) const {
  const vec4 p01 = glm::mix(b[0], b[1], t), p12 = glm::mix(b[1], b[2], t), p23 = glm::mix(b[2], b[3], t);
  const vec4 p012 = glm::mix(p01, p12, t), p123 = glm::mix(p12, p23, t);
  const vec4 middle = glm::mix(p012, p123, t);
  return {Bezier{{b[0], p01, p012, middle}}, Bezier{{middle, p123, p23, b[3]}}};
}

float Bezier::nearest(vec3 p) const {
  constexpr int kSamples = 8, kSteps = 3;
  constexpr float kLeastCurvature = 0.2f;  // of the squared speed: beyond a bend's centre there is no minimum
  float best = 0, least = std::numeric_limits<float>::infinity();
  for (int k = 0; k <= kSamples; ++k) {
    const float t = float(k) / kSamples;
    const vec3 gap = vec3(at(t)) - p;
    if (glm::dot(gap, gap) < least) least = glm::dot(gap, gap), best = t;
  }
  for (int step = 0; step < kSteps; ++step) {
    const vec3 gap = vec3(at(best)) - p, first(derivative(best)), second(secondDerivative(best));
    const float speed = glm::dot(first, first),
                curvature = std::max(speed + glm::dot(gap, second), kLeastCurvature * speed);
    if (!(curvature > 0)) break;
    best = std::clamp(best - glm::dot(gap, first) / curvature, 0.0f, 1.0f);
  }
  return best;
}

Aabb Bezier::bounds() const {
  Aabb box;
  for (const vec4& point : b) box.add(vec3(point), point.w);
  return box;
}

const std::array<vec4, (1 << kBernsteinLevels) + 1>& bernsteinTable() {
  static const auto table = [] {
    std::array<vec4, (1 << kBernsteinLevels) + 1> values;
    for (std::size_t j = 0; j < values.size(); ++j) values[j] = bernstein(float(j) / (1 << kBernsteinLevels));
    return values;
  }();
  return table;
}

}  // namespace vasa
