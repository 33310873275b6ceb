#include "network/measure_course.h"

#include <algorithm>
#include <cmath>

#include "curve/bspline.h"

namespace vasa {
namespace {

constexpr float kCourseStep = 0.001f;  // [m]
constexpr float kShareOfArc = 1 / 60.0f;
// [radians] a turn from station to station that is none: its plane is chance
constexpr float kStraight = 0.02f;
constexpr int kLooks = 8;  // a span, for the sharpest bend

float angleBetween(vec3 a, vec3 b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

void sharpestBend(std::span<const vec4> points, CourseMeasures& out) {
  float most = 0;
  double along = 0;
  for (std::uint32_t span = 0; span < spanCount(points); ++span) {
    const Bezier segment = bezierOfSpan(points, span);
    for (int k = 0; k <= kLooks; ++k) {
      const float t = float(k) / kLooks;
      if (k > 0) along += double(glm::length(vec3(segment.derivative(t)))) / kLooks;
      const float curvature = segment.curvature(t);
      if (curvature > most) most = curvature, out.bendAt = float(along);
      out.greatestKink = std::max(out.greatestKink, curvature * segment.at(t).w);
    }
  }
  // What rounding makes of a straight vessel bends by kilometres.
  out.leastBendRadius = most > 1e-3f ? 1 / most : 0;
}

}  // namespace

CourseMeasures measureCourse(std::span<const vec4> points) {
  CourseMeasures out;
  sharpestBend(points, out);
  out.arc = lengthOf(points);
  out.chord = glm::distance(vec3(points.front()), vec3(points.back()));
  const auto stations = stationsOf(points, std::max(kCourseStep, kShareOfArc * out.arc));
  std::vector<vec3> steps;
  for (std::size_t i = 1; i < stations.size(); ++i)
    steps.push_back(stations[i].centre - stations[i - 1].centre);
  double sum = 0;
  vec3 lastNormal(0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const float inPlane = angleBetween(steps[i - 1], steps[i]);
    float outOfPlane = 0;
    if (inPlane > kStraight) {
      const vec3 normal = glm::normalize(glm::cross(steps[i - 1], steps[i]));
      if (glm::dot(lastNormal, lastNormal) > 0) {
        const float turn = angleBetween(lastNormal, normal);
        // A bend that goes over to the other side turns its plane by 180 degrees: that is an inflection, no
        // torsion.
        outOfPlane = turn > 0.5f * kPi ? kPi - turn : turn;
        out.inflections += turn > 0.5f * kPi;
      }
      lastNormal = normal;
    }
    sum += double(std::hypot(inPlane, outOfPlane));
  }
  out.sumOfAngles = out.arc > 0 ? float(sum) / out.arc : 0;
  out.tortuosity = out.chord > 1e-3f * out.arc ? out.arc / out.chord : 0;
  out.inflectionMetric = float(out.inflections + 1) * out.tortuosity;
  return out;
}

}  // namespace vasa
