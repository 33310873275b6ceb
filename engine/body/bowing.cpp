#include "body/bowing.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

// Of lost length, how much comes back: with a quarter 14 of 25 published figures lie within one standard
// deviation, with none 12, as vessels then neither bend nor twist between joints; with a half they shorten
// too little.
constexpr float kBowing = 0.25f;

// The axis of rest that a course mainly runs along.
int mainAxis(std::span<const vec4> rest) {
  const vec3 way = glm::abs(vec3(rest.back() - rest.front()));
  if (way.y >= way.x && way.y >= way.z) return 1;
  return way.x >= way.z ? 0 : 2;
}

// By what a wave in control points comes out smaller on their curve: a cubic B-spline keeps (2 + cos ω) / 3
// of a wave that goes on by ω from point to point. Waves of fewer than three points are left out, as points
// so far apart cannot tell one from another.
float drawn(float omega) {
  return 3 / (2 + std::cos(std::min(omega, 0.75f * kPi))) *
         (1 - glm::smoothstep(0.6f * kPi, 0.9f * kPi, omega));
}

}  // namespace

std::vector<vec3> outwardsOf(const Binding& binding, std::span<const vec4> rest) {
  const std::vector<Station> stations = mainStations(binding);
  std::vector<vec3> outwards;
  outwards.reserve(stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const SpineJoint& joint = binding.spines.joints[stations[i].joint.value];
    vec3 off = vec3(rest[i]) - joint.centre;
    off -= glm::dot(off, joint.axis) * joint.axis;
    outwards.push_back(glm::length(off) > 0 ? glm::normalize(off) : vec3(0));
  }
  return outwards;
}

void bow(const BowCourse& course, std::span<float> lost, std::span<vec3> aside) {
  const std::size_t n = course.along.size();
  lost[0] = 0;  // [m] up to each point
  for (std::size_t k = 1; k < n; ++k)
    lost[k] = lost[k - 1] + std::max(1 - course.stretch[k], 0.0f) * (course.along[k] - course.along[k - 1]);
  const auto lostUpTo = [&](float at) {
    const auto next = std::size_t(std::ranges::upper_bound(course.along, at) - course.along.begin());
    if (next == 0) return 0.0f;
    if (next == n) return lost.back();
    const float first = course.along[next - 1];
    return glm::mix(lost[next - 1], lost[next], (at - first) / (course.along[next] - first));
  };
  const int axis = mainAxis(course.rest);
  vec3 upwards(0);
  upwards[axis] = course.rest[n / 2].x < 0 ? -1.0f : 1.0f;  // the other hand on the body's other side
  for (std::size_t k = 0; k < n; ++k) {
    aside[k] = vec3(0);
    const float at = course.along[k], first = std::max(at - kBowWave / 2, 0.0f),
                last = std::min(at + kBowWave / 2, course.along.back());
    const float squeezed = (lostUpTo(last) - lostUpTo(first)) / (last - first), bed = 1 - squeezed;
    if (!(squeezed > 0) || !(bed > 0)) continue;
    float free = 1;
    for (const float hold : course.holds) free *= glm::smoothstep(0.0f, kBowWave / 2, std::abs(at - hold));
    const std::size_t before = k > 0 ? k - 1 : 0, after = std::min(k + 1, n - 1);
    const float apart =
        std::abs(course.rest[after][axis] - course.rest[before][axis]) / float(after - before);
    // A helix of radius A and pitch P is longer than its pitch by √(1 + (2πA/P)²).
    const float longer = 1 + kBowing * squeezed / bed;
    const float radius = std::sqrt(longer * longer - 1) * bed * kBowWave / (2 * kPi);
    const float phase = 2 * kPi * course.rest[k][axis] / kBowWave;
    const vec3 out = course.outwards[k];
    aside[k] = free * radius * drawn(2 * kPi * apart / kBowWave) *
               glm::smoothstep(kBowRadius / 2, kBowRadius, course.rest[k].w) *
               (course.turned[k] * (std::cos(phase) * out - std::sin(phase) * glm::cross(upwards, out)));
  }
}

}  // namespace vasa
