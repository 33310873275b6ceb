#include "mesh/winding_number.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "math/closest_point.h"

using namespace vasa;

TEST_CASE("the winding number is 1 inside a closed surface, 0 outside and 2 where two overlap") {
  // A ball of 5,000 faces, so that groups of far ones are told by their dipole.
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  constexpr std::uint32_t kRows = 50, kColumns = 50;
  const auto addBall = [&](vec3 centre, float radius) {
    const std::uint32_t first = std::uint32_t(positions.size());
    for (std::uint32_t row = 0; row <= kRows; ++row)
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        const float theta = kPi * float(row) / kRows, phi = 2 * kPi * float(column) / kColumns;
        positions.push_back(centre + radius * vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                   -std::sin(theta) * std::sin(phi)));
      }
    const auto at = [&](std::uint32_t row, std::uint32_t column) {
      return first + row * kColumns + column % kColumns;
    };
    for (std::uint32_t row = 0; row < kRows; ++row)
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
        triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
      }
  };
  addBall(vec3(0), 1);
  addBall(vec3(0.8f, 0, 0), 0.7f);
  const WindingNumber winding(positions, triangles);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-2, 2);
  for (int k = 0; k < 5000; ++k) {
    const vec3 p{any(random), any(random), any(random)};
    const float one = glm::length(p) - 1, other = glm::distance(p, vec3(0.8f, 0, 0)) - 0.7f;
    if (std::min(std::abs(one), std::abs(other)) < 0.02f) continue;
    CHECK(winding.at(p) ==
          doctest::Approx((one < 0 ? 1 : 0) + (other < 0 ? 1 : 0)).epsilon(0.0).scale(1).epsilon(0.05));
  }
}

TEST_CASE("what comes within reach of a point is found, and little else") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1), little(-0.05f, 0.05f);
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  for (std::uint32_t k = 0; k < 3000; ++k) {
    const vec3 place{any(random), any(random), any(random)};
    for (int corner = 0; corner < 3; ++corner)
      positions.push_back(place + vec3{little(random), little(random), little(random)});
    triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const WindingNumber winding(positions, triangles);
  for (int k = 0; k < 50; ++k) {
    const vec3 point{any(random), any(random), any(random)};
    std::vector<Triangle> near;
    winding.addNear(point, 0.2f, near);
    std::size_t within = 0;
    for (const uvec3& t : triangles) {
      const Triangle own{positions[t.x], positions[t.y], positions[t.z]};
      if (glm::distance(closestOnTriangle(point, own.a, own.b, own.c).point, point) > 0.2f) continue;
      ++within;
      CHECK(std::ranges::count_if(near, [&](const Triangle& found) { return found.a == own.a; }) == 1);
    }
    CHECK(near.size() < 300 + 2 * within);
  }
}

TEST_CASE("no triangles wind around nothing") {
  const WindingNumber winding({}, {});
  CHECK(winding.at(vec3(1)) == 0);
  std::vector<Triangle> near;
  winding.addNear(vec3(1), 10, near);
  CHECK(near.empty());
}
