#include "surface/sweep_template.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace vasa;

TEST_CASE("ring directions are the regular polygon's") {
  for (std::uint32_t around = 3; around <= 16; ++around) {
    const std::vector<vec2> directions = ringDirections(around);
    REQUIRE(directions.size() == around);
    CHECK(directions[0] == vec2(1, 0));
    for (std::uint32_t k = 0; k < around; ++k) {
      const double angle = 2 * double(kPi) * k / around;
      CHECK(glm::distance(directions[k], vec2(std::cos(angle), std::sin(angle))) < 2e-6f);
    }
  }
}

TEST_CASE("templates name every vertex and have the triangles that the shape counts") {
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{8, 5}, SweepShape{16, 20}}) {
    CHECK(shape.valid());
    const std::vector<uvec3> sweep = sweepTriangles(shape), cap = capTriangles(shape);
    CHECK(sweep.size() == shape.sweepTriangles());
    CHECK(cap.size() == shape.capTriangles());
    std::vector<int> used(shape.sweepVertices()), usedByCap(shape.capVertices());
    for (const uvec3& t : sweep)
      for (int i = 0; i < 3; ++i) ++used.at(t[i]);
    for (const uvec3& t : cap)
      for (int i = 0; i < 3; ++i) ++usedByCap.at(t[i]);
    CHECK(std::count(used.begin(), used.end(), 0) == 0);
    CHECK(std::count(usedByCap.begin(), usedByCap.end(), 0) == 0);
  }
  CHECK(!SweepShape{2, 5}.valid());
  CHECK(!SweepShape{17, 5}.valid());
  CHECK(!SweepShape{8, 1}.valid());
  CHECK(!SweepShape{8, 21}.valid());
}

TEST_CASE("cap angles run from the rim to the pole") {
  const std::vector<vec2> angles = capAngles();
  REQUIRE(angles.size() == shared::kCapRings + 1);
  CHECK(angles.front() == vec2(1, 0));
  CHECK(angles.back() == vec2(0, 1));
  for (std::size_t i = 1; i < angles.size(); ++i) CHECK(angles[i].y > angles[i - 1].y);
}
