#include "mesh/surface_samples.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("samples share a surface by area and lie on it") {
  // Two squares, one of four times the area of the other, in many and in few triangles.
  TriangleMesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {7, 0, 0}, {7, 2, 0}, {5, 2, 0}, {6, 1, 0}},
      {{0, 1, 2}, {0, 2, 3}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}}};
  const auto samples = sampleSurface(mesh, 1000);
  REQUIRE(samples.size() == 1000);
  int small = 0;
  vec3 mean(0);
  for (const vec3& p : samples) {
    CHECK(p.z == 0);
    small += p.x <= 1;
    if (p.x > 1) mean += p / 800.0f;
  }
  CHECK(small == 200);
  CHECK(glm::distance(mean, vec3(6, 1, 0)) < 0.02f);
}

TEST_CASE("no area, no samples") {
  CHECK(sampleSurface({}, 10).empty());
  CHECK(sampleSurface({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}, 10).empty());
  CHECK(sampleSurface({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0).empty());
}
