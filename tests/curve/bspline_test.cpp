#include "curve/bspline.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace vasa;

namespace {

std::vector<vec4> randomSpline(std::uint32_t spans, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1), radius(0.01f, 0.3f);
  std::vector<vec4> points(spans + 3);
  for (vec4& p : points) p = {value(random), value(random), value(random), radius(random)};
  return points;
}

// The textbook definition, straight from the knots: Cox-de Boor.
double basis(int i, int degree, double u, int spans) {
  const auto knot = [spans](int k) { return double(std::clamp(k - 3, 0, spans)); };
  if (degree == 0) {
    const bool last = knot(i + 1) == spans && u == spans && knot(i) < spans;
    return (u >= knot(i) && u < knot(i + 1)) || last;
  }
  double sum = 0;
  if (knot(i + degree) > knot(i))
    sum += (u - knot(i)) / (knot(i + degree) - knot(i)) * basis(i, degree - 1, u, spans);
  if (knot(i + degree + 1) > knot(i + 1))
    sum += (knot(i + degree + 1) - u) / (knot(i + degree + 1) - knot(i + 1)) *
           basis(i + 1, degree - 1, u, spans);
  return sum;
}

}  // namespace

TEST_CASE("inner spans have the uniform B-spline's matrix") {
  const mat4 m = spanToBezier(5, 12);
  const vec4 d(6, 12, 18, 30);  // b0 = (d0+4d1+d2)/6 and so on
  CHECK(glm::distance(m * d, vec4((6 + 48 + 18) / 6.0f, (24 + 18) / 3.0f, (12 + 36) / 3.0f,
                                  (12 + 72 + 30) / 6.0f)) < 1e-5f);
}

TEST_CASE("one span is its own Bezier") { CHECK(spanToBezier(0, 1) == mat4(1)); }

TEST_CASE("the spline is the one of the textbook, for every number of spans") {
  for (const std::uint32_t spans : {1u, 2u, 3u, 4u, 5u, 9u}) {
    const auto points = randomSpline(spans, spans);
    for (int step = 0; step <= 40; ++step) {
      const float u = float(spans) * float(step) / 40;
      glm::dvec4 expected(0);
      for (int i = 0; i < int(points.size()); ++i)
        expected += basis(i, 3, double(u), int(spans)) * glm::dvec4(points[i]);
      CHECK(glm::distance(vec4(expected), evaluate(points, u)) < 2e-6f);
    }
    CHECK(evaluate(points, 0) == points.front());
    CHECK(glm::distance(evaluate(points, float(spans)), points.back()) < 1e-6f);
  }
}

TEST_CASE("spans meet with equal value, first and second derivative") {
  const auto points = randomSpline(7, 11);
  for (std::uint32_t span = 0; span + 1 < 7; ++span) {
    const Bezier a = bezierOfSpan(points, span), b = bezierOfSpan(points, span + 1);
    CHECK(glm::distance(a.b[3], b.b[0]) < 1e-6f);
    CHECK(glm::distance(a.derivative(1), b.derivative(0)) < 1e-5f);
    CHECK(glm::distance(a.secondDerivative(1), b.secondDerivative(0)) < 1e-4f);
  }
}

TEST_CASE("weights reproduce the point, and are an average") {
  const auto points = randomSpline(5, 2);
  for (std::uint32_t span = 0; span < 5; ++span)
    for (const float t : {0.0f, 0.2f, 0.77f, 1.0f}) {
      const vec4 w = deBoorWeights(span, 5, t);
      vec4 sum(0);
      for (int l = 0; l < 4; ++l) sum += w[l] * points[span + l];
      CHECK(glm::distance(sum, evaluate(points, float(span) + t)) < 1e-5f);
      CHECK(w.x + w.y + w.z + w.w == doctest::Approx(1));
      for (int l = 0; l < 4; ++l) CHECK(w[l] >= -1e-7f);
    }
}

TEST_CASE("parameters outside are held at the ends") {
  const auto points = randomSpline(3, 4);
  CHECK(evaluate(points, -2) == points.front());
  CHECK(glm::distance(evaluate(points, 99), points.back()) < 1e-6f);
  CHECK(locate(3, 3).span == 2);
  CHECK(locate(3, 3).t == 1);
}

TEST_CASE("length and volume of a straight cylinder and a cone") {
  std::vector<vec4> cylinder, cone;
  for (int i = 0; i < 4; ++i) {
    const float x = float(i) / 3;
    cylinder.push_back({0.3f * x, 0, 0, 0.01f});
    cone.push_back({0.3f * x, 0, 0, 0.01f * (1 + x)});
  }
  CHECK(lengthOf(cylinder) == doctest::Approx(0.3));
  CHECK(volumeOf(cylinder) == doctest::Approx(kPi * 1e-4 * 0.3).epsilon(1e-5));
  CHECK(volumeOf(cone) == doctest::Approx(kPi / 3 * 1e-4 * 0.3 * (1 + 2 + 4)).epsilon(1e-5));
}
