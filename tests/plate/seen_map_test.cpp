#include "plate/seen_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace vasa;
using namespace vasa::plate;

namespace {

// A picture of 2 m by 1 m of the plane z = 0, from 5 m in front of it.
Camera inFront() {
  return {.position = {0, 0, 5}, .target = vec3(0), .orthographicHeight = 1, .farDistance = 20};
}

// A square of half a metre around a place.
void drawSquare(SeenMap& map, vec3 at, std::uint32_t number) {
  const std::vector<vec3> corners{at + vec3(-0.25f, -0.25f, 0), at + vec3(0.25f, -0.25f, 0),
                                  at + vec3(0.25f, 0.25f, 0), at + vec3(-0.25f, 0.25f, 0)};
  const std::vector<uvec3> triangles{{0, 1, 2}, {0, 2, 3}};
  map.draw(corners, triangles, [&](std::uint32_t) { return number; });
}

std::size_t count(const SeenMap& map, std::uint32_t number) {
  return std::size_t(std::ranges::count(map.cells(), number));
}

}  // namespace

TEST_CASE("a square covers its cells once, and the picture's y runs down") {
  SeenMap map(inFront(), 200, 100);
  drawSquare(map, vec3(0.5f, 0.2f, 0), 7);
  CHECK(count(map, 7) == 50 * 50);
  CHECK(map.at(150, 30) == 7);
  CHECK(map.at(150, 60) == SeenMap::kNothing);
  vec2 cell;
  REQUIRE(map.project(vec3(0.5f, 0.2f, 0), cell));
  CHECK(cell.x == doctest::Approx(150));
  CHECK(cell.y == doctest::Approx(30));
  CHECK(map.cellsAMetre(vec3(0)) == doctest::Approx(100));
}

TEST_CASE("the nearer thing is seen, in whichever order they are drawn") {
  for (const bool nearFirst : {false, true}) {
    SeenMap map(inFront(), 200, 100);
    if (nearFirst) drawSquare(map, vec3(0.1f, 0, 1), 1);
    drawSquare(map, vec3(0, 0, 0), 2);
    if (!nearFirst) drawSquare(map, vec3(0.1f, 0, 1), 1);
    CHECK(count(map, 1) == 2500);
    CHECK(count(map, 2) == 500);
  }
}

TEST_CASE("what is cut off, behind the eye or numbered as nothing hides nothing") {
  Camera camera = inFront();
  camera.cut = vec4(0, 0, -1, 0.5f);  // away with what is nearer than z = 0.5
  SeenMap map(camera, 200, 100);
  drawSquare(map, vec3(0), 2);
  drawSquare(map, vec3(0, 0, 1), 1);
  drawSquare(map, vec3(0, 0, 0.2f), SeenMap::kNothing);
  drawSquare(map, vec3(0, 0, 6), 3);
  CHECK(count(map, 2) == 2500);
  CHECK(count(map, 1) == 0);
  CHECK(count(map, 3) == 0);
}

TEST_CASE("in perspective a metre takes fewer cells farther away") {
  const Camera camera{.position = {0, 0, 2}, .target = vec3(0), .verticalAngle = 1};
  const SeenMap map(camera, 100, 100);
  CHECK(map.cellsAMetre(vec3(0)) == doctest::Approx(100 / (4 * std::tan(0.5f))));
  CHECK(map.cellsAMetre(vec3(0, 0, -2)) == doctest::Approx(map.cellsAMetre(vec3(0)) / 2));
  vec2 cell;
  CHECK_FALSE(map.project(vec3(0, 0, 3), cell));
}
