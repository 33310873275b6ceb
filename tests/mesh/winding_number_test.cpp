#include "mesh/winding_number.h"

#include <doctest/doctest.h>

#include <random>

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

TEST_CASE("no triangles wind around nothing") {
  const WindingNumber winding({}, {});
  CHECK(winding.at(vec3(1)) == 0);
}
