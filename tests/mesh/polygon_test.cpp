#include "mesh/polygon.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <utility>

using namespace vasa;

namespace {

std::vector<uvec3> cut(const std::vector<vec3>& corners) {
  std::vector<uvec3> triangles;
  cutPolygon(corners, triangles);
  return triangles;
}

double areaOf(const std::vector<vec3>& p, const std::vector<uvec3>& triangles) {
  double area = 0;
  for (const uvec3& t : triangles) area += 0.5 * glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
  return area;
}

// A star about the origin: every second corner turns inward.
std::vector<vec3> star(std::uint32_t corners, vec3 u, vec3 v) {
  std::vector<vec3> p;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = 2 * kPi * float(i) / float(corners), radius = i % 2 ? 0.4f : 1.0f;
    p.push_back(radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return p;
}

}  // namespace

TEST_CASE("a quadrangle is cut along its shorter diagonal") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == std::vector<uvec3>{{0, 1, 2}});
  CHECK(cut({{0, 0, 0}, {2, 1, 0}, {1, 2, 0}, {-2, 3, 0}}) == std::vector<uvec3>{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut({{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}}) == std::vector<uvec3>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("a star's triangles cover it once and turn as it does, however it lies") {
  const std::pair<vec3, vec3> planes[] = {{vec3(1, 0, 0), vec3(0, 1, 0)},
                                          {vec3(0, 1, 0), vec3(1, 0, 0)},
                                          {vec3(0, 0, 1), vec3(0, 1, 0)},
                                          {vec3(0.6f, 0, 0.8f), vec3(0, 1, 0)}};
  for (const auto& [u, v] : planes) {
    const auto corners = star(24, u, v);
    const auto triangles = cut(corners);
    REQUIRE(triangles.size() == 22);
    const vec3 normal = glm::cross(u, v);
    for (const uvec3& t : triangles)
      CHECK(glm::dot(glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]), normal) > 0);
    CHECK(areaOf(corners, triangles) == doctest::Approx(12 * 1.0 * 0.4 * std::sin(kPi / 12)).epsilon(1e-4));
  }
}

TEST_CASE("corners in a line, at one place or crossing over cost no triangle") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size() == 3);
  CHECK(cut(std::vector<vec3>(7, vec3(1, 2, 3))).size() == 5);
  CHECK(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5f, 2, 0}}).size() == 3);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-1, 1);
  for (int round = 0; round < 100; ++round) {
    std::vector<vec3> corners(5 + std::size_t(round) % 40);
    for (vec3& p : corners) p = {anywhere(random), anywhere(random), anywhere(random)};
    const auto triangles = cut(corners);
    REQUIRE(triangles.size() == corners.size() - 2);
    std::vector<int> used(corners.size());
    for (const uvec3& t : triangles) ++used[t.x], ++used[t.y], ++used[t.z];
    for (const int times : used) CHECK(times > 0);
  }
}
