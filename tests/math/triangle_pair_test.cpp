#include "math/triangle_pair.h"

#include <doctest/doctest.h>

#include <random>

#include "segment_triangle.h"

using namespace vasa;

namespace {

const Triangle kFloor{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

Triangle moved(const Triangle& t, vec3 by) { return {t.a + by, t.b + by, t.c + by}; }

// By edges against triangles, both ways: another method.
float gap(const Triangle& p, const Triangle& q) {
  float least = 1e9f;
  const auto look = [&](const Triangle& s, const Triangle& t) {
    for (const auto& [from, to] : {std::pair{s.a, s.b}, {s.b, s.c}, {s.c, s.a}})
      least = std::min(least, test::closestOnSegmentTriangle(from, to, t.a, t.b, t.c).distance);
  };
  look(p, q);
  look(q, p);
  return least;
}

}  // namespace

TEST_CASE("triangles that stand in one another cross; apart, side by side and in one plane they do not") {
  const Triangle wall{{0.2f, 0.2f, -1}, {0.2f, 0.2f, 1}, {0.2f, 2, 0}};
  CHECK(trianglesCross(kFloor, wall));
  CHECK(trianglesCross(wall, kFloor));
  CHECK_FALSE(trianglesCross(kFloor, moved(wall, {0, 0, 2})));  // above
  CHECK_FALSE(trianglesCross(kFloor, moved(wall, {2, 0, 0})));  // through the plane, beside the triangle
  CHECK_FALSE(trianglesCross(kFloor, moved(kFloor, {0.1f, 0.1f, 0})));
  CHECK_FALSE(trianglesCross(kFloor, kFloor));
  CHECK_FALSE(trianglesCross(kFloor, {{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}));
}

TEST_CASE("a corner in the other's plane does not hide a crossing") {
  // Its first corner lies in the floor's plane, inside the floor; the others on both sides of it.
  CHECK(trianglesCross(kFloor, {{0.25f, 0.25f, 0}, {0.3f, 0.2f, 1}, {0.2f, 0.3f, -1}}));
  CHECK_FALSE(trianglesCross(kFloor, {{3, 0.25f, 0}, {3, 0.2f, 1}, {3, 0.3f, -1}}));
}

TEST_CASE("random triangles cross where an edge of one pierces the other") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto point = [&] { return vec3{unit(random), unit(random), unit(random)}; };
  int crossing = 0;
  for (int i = 0; i < 4000; ++i) {
    const Triangle p{point(), point(), point()}, q{point(), point(), point()};
    const bool found = trianglesCross(p, q);
    CHECK(found == trianglesCross(q, p));
    const float between = gap(p, q);
    if (found)
      CHECK(between < 1e-5f);
    else
      CHECK(between > 0);
    crossing += found;
  }
  CHECK(crossing > 400);
  CHECK(crossing < 3600);
}
