#include "curve/bezier.h"

#include <doctest/doctest.h>

#include <random>

using namespace vasa;

namespace {

Bezier randomBezier(std::mt19937& random) {
  std::uniform_real_distribution<float> value(-1, 1), radius(0.01f, 0.3f);
  Bezier curve;
  for (vec4& b : curve.b) b = {value(random), value(random), value(random), radius(random)};
  return curve;
}

}  // namespace

TEST_CASE("a cubic worked by hand") {
  const Bezier curve{{vec4(0, 0, 0, 1), vec4(1, 0, 0, 1), vec4(2, 3, 0, 2), vec4(3, 3, 0, 2)}};
  CHECK(curve.at(0) == vec4(0, 0, 0, 1));
  CHECK(curve.at(1) == vec4(3, 3, 0, 2));
  CHECK(curve.at(0.5f) == vec4(1.5f, 1.5f, 0, 1.5f));
  CHECK(curve.derivative(0) == vec4(3, 0, 0, 0));
  CHECK(curve.derivative(0.5f) == vec4(3, 4.5f, 0, 1.5f));
  CHECK(curve.secondDerivative(0) == vec4(0, 18, 0, 6));
}

TEST_CASE("splitting keeps the curve, and its box holds the tube") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Bezier curve = randomBezier(random);
    const auto [low, high] = curve.split(0.3f);
    const Aabb box = curve.bounds();
    for (int i = 0; i <= 10; ++i) {
      const float t = float(i) / 10;
      CHECK(glm::distance(low.at(t), curve.at(0.3f * t)) < 1e-5f);
      CHECK(glm::distance(high.at(t), curve.at(0.3f + 0.7f * t)) < 1e-5f);
      Aabb ball;
      ball.add(vec3(curve.at(t)), curve.at(t).w - 1e-5f);
      CHECK(glm::all(glm::lessThanEqual(box.low, ball.low)));
      CHECK(glm::all(glm::greaterThanEqual(box.high, ball.high)));
    }
  }
}

TEST_CASE("the shared table holds Bernstein values") {
  const auto& table = bernsteinTable();
  CHECK(table.front() == vec4(1, 0, 0, 0));
  CHECK(table.back() == vec4(0, 0, 0, 1));
  CHECK(table[512] == vec4(0.125f, 0.375f, 0.375f, 0.125f));
  for (const vec4& w : table) CHECK(w.x + w.y + w.z + w.w == doctest::Approx(1));
}

TEST_CASE(
    "the nearest point of a segment is as near as any of many samples, and its ends where it lies beyond") {
  const Bezier segment{{vec4(0, 0, 0, 1), vec4(1, 2, 0, 1), vec4(2, -1, 1, 1), vec4(3, 0, 0, 1)}};
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    const vec3 p(0.1f * float(k) - 0.5f, 0.4f * std::sin(float(k)), 0.3f * std::cos(2 * float(k)));
    float least = 1e30f;
    for (int j = 0; j <= 1000; ++j)
      least = std::min(least, glm::distance(p, vec3(segment.at(float(j) / 1000))));
    CHECK(glm::distance(p, vec3(segment.at(segment.nearest(p)))) < least + 1e-3f);
  }
  CHECK(segment.nearest({-5, 0, 0}) == 0);
  CHECK(segment.nearest({9, 0, 0}) == 1);
}
