#include "collide/distance_field.h"

#include <doctest/doctest.h>

#include <random>

#include "support/meshes.h"

using namespace vasa;

namespace {

struct Shell {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  void add(const SkinnedMesh& mesh) {
    const std::uint32_t first = std::uint32_t(positions.size());
    positions.insert(positions.end(), mesh.mesh.positions.begin(), mesh.mesh.positions.end());
    for (const uvec3& t : mesh.mesh.triangles) triangles.push_back(t + first);
  }
};

float boxDistance(vec3 p, vec3 low, vec3 high) {
  const vec3 q = glm::max(low - p, p - high);
  return glm::length(glm::max(q, vec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0f);
}

}  // namespace

TEST_CASE("the field is the distance from a box, near it") {
  const vec3 low(-0.02f, -0.03f, 0), high(0.02f, 0.03f, 0.05f);
  Shell shell;
  shell.add(test::boxMesh("box", low, high));
  const DistanceField field(shell.positions, shell.triangles, {.cell = 0.002f, .band = 0.006f});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-0.06f, 0.08f);
  float worst = 0;
  CHECK(field.clearance({0, 0, 0.12f}) > 0.05f);
  for (int k = 0; k < 20000; ++k) {
    const vec3 p{any(random), any(random), any(random)};
    const float exact = glm::clamp(boxDistance(p, low, high), -0.006f, 0.006f);
    const auto [distance, gradient] = field.at(p);
    CHECK(distance == field.distance(p));
    CHECK(field.clearance(p) <= std::max(boxDistance(p, low, high), 0.0f) + 0.001f);
    if (exact >= 0.006f) CHECK(distance <= boxDistance(p, low, high) + 1e-6f);
    const vec3 other = p + 0.05f * vec3{any(random), any(random), any(random)};
    if (distance < 0.006f)
      CHECK(std::min(field.distance(other), 0.006f) >=
            distance - std::sqrt(3.0f) * glm::distance(p, other) - 1e-6f);
    worst = std::max(worst, std::abs(std::min(distance, 0.006f) - exact));
    if (exact > 0.0025f && exact < 0.004f) CHECK(glm::length(gradient) == doctest::Approx(1).epsilon(0.3));
  }
  CHECK(worst < 0.0011f);  // half a cell, at the edges
  std::vector<vec4> balls;
  for (int k = 0; k < 21; ++k) balls.push_back({any(random), any(random), any(random), 0.001f});
  std::vector<float> distances(balls.size());
  field.distances(balls, distances);
  for (std::size_t k = 0; k < balls.size(); ++k) CHECK(distances[k] == field.distance(vec3(balls[k])));
  CHECK(field.distance(vec3(0, 0, 0.025f)) == doctest::Approx(-0.006f));
  CHECK(field.distance(vec3(1, 0, 0)) == doctest::Approx(0.006f));
}

TEST_CASE("a hollow whose ways out are narrower than the band is outside") {
  // Walls on four sides of a room of 40 mm, with gaps of 8 mm at its corners, a floor and a ceiling.
  Shell shell;
  shell.add(test::boxMesh("left", {-0.03f, -0.02f, -0.016f}, {-0.02f, 0.02f, 0.016f}));
  shell.add(test::boxMesh("right", {0.02f, -0.02f, -0.016f}, {0.03f, 0.02f, 0.016f}));
  shell.add(test::boxMesh("back", {-0.016f, -0.02f, -0.03f}, {0.016f, 0.02f, -0.02f}));
  shell.add(test::boxMesh("front", {-0.016f, -0.02f, 0.02f}, {0.016f, 0.02f, 0.03f}));
  shell.add(test::boxMesh("floor", {-0.03f, -0.04f, -0.03f}, {0.03f, -0.03f, 0.03f}));
  shell.add(test::boxMesh("ceiling", {-0.03f, 0.03f, -0.03f}, {0.03f, 0.04f, 0.03f}));
  const DistanceField field(shell.positions, shell.triangles, {.cell = 0.001f, .band = 0.006f});
  CHECK(field.distance({0, 0, 0}) >= 0.006f);
  CHECK(field.distance({0.025f, 0, 0}) < -0.004f);
}

TEST_CASE("the field's sign is right where a surface has rims, overlaps and the same face twice") {
  // A box without its lid's middle, a second one that reaches into it, and one of its walls again.
  const vec3 low(-0.02f, -0.03f, 0), high(0.02f, 0.03f, 0.05f);
  Shell shell;
  shell.add(test::boxMesh("box", low, high));
  const auto wall = shell.triangles.front();
  shell.triangles.push_back(wall);
  shell.triangles.erase(shell.triangles.begin() + 1);
  shell.add(test::boxMesh("other", {-0.01f, -0.01f, 0.04f}, {0.01f, 0.01f, 0.08f}));
  const DistanceField field(shell.positions, shell.triangles, {.cell = 0.002f, .band = 0.006f});
  CHECK(field.distance({0, 0, 0.044f}) < 0);  // in both
  CHECK(field.distance({0, 0, 0.07f}) < 0);
  CHECK(field.distance({0.015f, 0.02f, 0.025f}) < 0);
  // Beyond the band, where the nearest face that is looked at may be one seen from behind.
  for (const vec3 out : {vec3(0.04f, 0.045f, 0.065f), vec3(-0.033f, 0, 0.062f), vec3(0.027f, 0.037f, 0.056f)})
    CHECK(field.distance(out) > 0);
}
