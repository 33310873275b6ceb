#include "segment_triangle.h"

#include <doctest/doctest.h>

#include <random>

#include "math/closest_point.h"

using namespace vasa;

TEST_CASE("a segment that pierces, hovers, passes an edge, lies in the plane") {
  const vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto through = test::closestOnSegmentTriangle({0.25f, 0.25f, -1}, {0.25f, 0.25f, 3}, a, b, c);
  CHECK(through.distance == 0);
  CHECK(through.s == doctest::Approx(0.25));
  CHECK(through.point == vec3(0.25f, 0.25f, 0));
  CHECK(test::closestOnSegmentTriangle({0.1f, 0.1f, 1}, {0.2f, 0.2f, 0.5f}, a, b, c).distance ==
        doctest::Approx(0.5));
  const auto edge = test::closestOnSegmentTriangle({0.5f, -1, -1}, {0.5f, -1, 1}, a, b, c);
  CHECK(edge.distance == doctest::Approx(1));
  CHECK(edge.s == doctest::Approx(0.5));
  CHECK(test::closestOnSegmentTriangle({-1, 0.25f, 0}, {2, 0.25f, 0}, a, b, c).distance ==
        doctest::Approx(0));
  CHECK(test::closestOnSegmentTriangle({0, 0, 2}, {0, 0, 2}, a, a, a).distance == doctest::Approx(2));
}

TEST_CASE("no sampled pair of points is nearer") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1, 1);
  const auto point = [&] { return vec3(value(random), value(random), value(random)); };
  for (int trial = 0; trial < 2000; ++trial) {
    const vec3 p = point(), q = point(), a = point(), b = point(), c = point();
    const auto near = test::closestOnSegmentTriangle(p, q, a, b, c);
    const vec3 onTriangle = near.barycentric.x * a + near.barycentric.y * b + near.barycentric.z * c;
    CHECK(glm::distance(onTriangle, near.point) < 1e-5f);
    CHECK(glm::distance(glm::mix(p, q, near.s), near.point) ==
          doctest::Approx(near.distance).scale(1).epsilon(1e-5));
    for (int k = 0; k <= 32; ++k) {
      const vec3 x = glm::mix(p, q, float(k) / 32);
      CHECK(near.distance <= glm::distance(x, closestOnTriangle(x, a, b, c).point) + 1e-5f);
    }
  }
}
