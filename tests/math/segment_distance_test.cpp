#include "math/segment_distance.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace vasa;

TEST_CASE("segments that cross, pass, follow one another, and points") {
  const auto crossing = closestOnSegments(vec3(-1, 0, 0), vec3(1, 0, 0), vec3(0, -1, 0.5f), vec3(0, 3, 0.5f));
  CHECK(crossing.s == doctest::Approx(0.5));
  CHECK(crossing.t == doctest::Approx(0.25));
  CHECK(crossing.distance == doctest::Approx(0.5));
  const auto inLine = closestOnSegments(vec3(0, 0, 0), vec3(1, 0, 0), vec3(3, 0, 0), vec3(2, 0, 0));
  CHECK(inLine.s == 1);
  CHECK(inLine.t == 1);
  CHECK(inLine.distance == 1);
  const auto points = closestOnSegments(vec3(1), vec3(1), vec3(1, 1, 3), vec3(1, 1, 3));
  CHECK(points.distance == 2);
  const auto point = closestOnSegments(vec3(0.25f, 2, 0), vec3(0.25f, 2, 0), vec3(0), vec3(1, 0, 0));
  CHECK(point.t == doctest::Approx(0.25));
  CHECK(point.distance == doctest::Approx(2));
}

TEST_CASE("parallel segments, overlapping or not") {
  CHECK(closestOnSegments(vec3(0), vec3(4, 0, 0), vec3(1, 2, 0), vec3(3, 2, 0)).distance == 2);
  CHECK(closestOnSegments(vec3(0), vec3(1, 0, 0), vec3(4, 4, 0), vec3(9, 4, 0)).distance == 5);
  CHECK(closestOnSegments(vec3(0), vec3(1, 0, 0), vec3(0), vec3(1, 0, 0)).distance == 0);
}

namespace {

// The reference: ternary search over s, which is convex once t is solved for exactly.
double trueDistance(dvec3 p0, dvec3 p1, dvec3 q0, dvec3 q1) {
  const auto toSecond = [&](double s) {
    const dvec3 p = p0 + s * (p1 - p0), v = q1 - q0;
    const double vv = glm::dot(v, v), t = vv > 0 ? glm::clamp(glm::dot(p - q0, v) / vv, 0.0, 1.0) : 0.0;
    return glm::distance(p, q0 + t * v);
  };
  double low = 0, high = 1;
  for (int k = 0; k < 200; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (toSecond(a) < toSecond(b) ? high : low) = toSecond(a) < toSecond(b) ? b : a;
  }
  return std::min({toSecond(0), toSecond(1), toSecond(0.5 * (low + high))});
}

}  // namespace

TEST_CASE("random and near-parallel segments: the distance is right, and its slack covers single precision") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto vector = [&] { return dvec3(value(random), value(random), value(random)); };
  for (int trial = 0; trial < 20000; ++trial) {
    const double tilt = std::pow(10.0, -8 * std::abs(value(random)));
    const dvec3 p0 = vector(), u = vector(), q0 = p0 + 0.1 * vector();
    const dvec3 q1 = q0 + (trial % 2 ? vector() : value(random) * u + tilt * vector());
    const double truth = trueDistance(p0, p0 + u, q0, q1);
    CHECK(closestOnSegments(p0, p0 + u, q0, q1).distance == doctest::Approx(truth).epsilon(1e-7));
    const vec3 fp0(p0), fp1(p0 + u), fq0(q0), fq1(q1);
    const double single = closestOnSegments(fp0, fp1, fq0, fq1).distance;
    const double exact = trueDistance(dvec3(fp0), dvec3(fp1), dvec3(fq0), dvec3(fq1));
    const double sizes = glm::dot(u, u) + glm::dot(q1 - q0, q1 - q0) + glm::dot(p0 - q0, p0 - q0);
    CHECK(single * single - kSegmentSlack<float> * sizes <= exact * exact);
    CHECK(single * single + kSegmentSlack<float> * sizes >= exact * exact);
  }
}
