#include "curve/arc_length.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("arc length along a straight spline is the way along it, and back") {
  const std::vector<vec4> points{{0, 0, 0, 1}, {0, 0, 1, 1}, {0, 0, 2, 1}, {0, 0, 3, 1}};
  const ArcLength arc(points);
  CHECK(arc.length() == doctest::Approx(3));
  CHECK(arc.along(0.5f) == doctest::Approx(1.5));
  CHECK(arc.parameterAt(0.75f) == doctest::Approx(0.25));
  CHECK(arc.parameterAt(-1) == 0);
  CHECK(arc.parameterAt(9) == 1);
}

TEST_CASE("arc length of a bent spline agrees with quadrature, and both ways are one another's inverse") {
  const std::vector<vec4> points{{0, 0, 0, 1}, {1, 0, 0, 1}, {3, 1, 0, 1},
                                 {4, 4, 1, 1}, {4, 6, 3, 1}, {0, 6, 5, 1}};
  const ArcLength arc(points);
  CHECK(arc.length() == doctest::Approx(lengthOf(points)).epsilon(1e-4));
  for (int k = 0; k <= 30; ++k) {
    const float u = 3 * float(k) / 30;
    CHECK(arc.parameterAt(arc.along(u)) == doctest::Approx(u).epsilon(1e-4));
  }
}

TEST_CASE("arc length of a spline without length is zero everywhere") {
  const std::vector<vec4> points(4, vec4(1, 2, 3, 1));
  const ArcLength arc(points);
  CHECK(arc.length() == 0);
  CHECK(arc.parameterAt(0.5f) <= 1);
}
