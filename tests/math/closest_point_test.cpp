#include "math/closest_point.h"

#include <doctest/doctest.h>

#include <random>

#include "math/aabb.h"

using namespace vasa;

TEST_CASE("nearest point of a segment") {
  CHECK(closestOnSegment({0.25f, 3, 0}, {0, 0, 0}, {1, 0, 0}) == doctest::Approx(0.25));
  CHECK(closestOnSegment({-5, 1, 0}, {0, 0, 0}, {1, 0, 0}) == 0);
  CHECK(closestOnSegment({5, 1, 0}, {0, 0, 0}, {1, 0, 0}) == 1);
  CHECK(closestOnSegment({5, 1, 0}, {2, 2, 2}, {2, 2, 2}) == 0);
}

TEST_CASE("nearest point of a triangle: face, edge, corner, sliver") {
  const vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(closestOnTriangle({0.25f, 0.25f, 2}, a, b, c).point == vec3(0.25f, 0.25f, 0));
  CHECK(closestOnTriangle({0.5f, -1, 0}, a, b, c).point == vec3(0.5f, 0, 0));
  CHECK(closestOnTriangle({-1, -1, 5}, a, b, c).point == a);
  const auto sliver = closestOnTriangle({0.5f, 1, 0}, a, b, 0.5f * (a + b));
  CHECK(glm::distance(sliver.point, vec3(0.5f, 0, 0)) < 1e-6f);
}

TEST_CASE("no sampled point of a triangle is nearer than the answer") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1, 1);
  const auto point = [&] { return vec3(value(random), value(random), value(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    const vec3 a = point(), b = point(), c = point(), p = point() * 2.0f;
    const auto [q, w] = closestOnTriangle(p, a, b, c);
    CHECK(glm::distance(q, w.x * a + w.y * b + w.z * c) < 1e-5f);
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const vec3 sample = a + float(i) / 20 * (b - a) + float(j) / 20 * (c - a);
        CHECK(glm::distance(p, q) <= glm::distance(p, sample) + 1e-5f);
      }
  }
}

TEST_CASE("boxes grow and overlap") {
  Aabb box;
  CHECK(box.empty());
  box.add({1, 1, 1}, 0.5f);
  CHECK(box.centre() == vec3(1));
  CHECK(box.extent() == vec3(1));
  Aabb other;
  other.add(vec3(1.5f));
  CHECK(box.overlaps(other));
  other = {};
  other.add(vec3(1.6f));
  CHECK(!box.overlaps(other));
  CHECK(!Aabb{}.overlaps(box));
}
