#include "collide/obstacle.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/hash.h"
#include "core/parallel.h"
#include "mesh/triangle_mesh.h"
#include "random_tubes.h"

using namespace vasa;

namespace {

// A sphere of unit radius about the origin, as a closed mesh.
TriangleMesh ball(std::uint32_t around, std::uint32_t along) {
  TriangleMesh mesh;
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 1; i < along; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const float theta = kPi * float(i) / float(along), phi = 2 * kPi * float(k) / float(around);
      mesh.positions.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  mesh.positions.push_back({0, 0, -1});
  const std::uint32_t last = std::uint32_t(mesh.positions.size()) - 1;
  for (std::uint32_t k = 0; k < around; ++k) {
    const std::uint32_t n = (k + 1) % around;
    mesh.triangles.push_back({0, 1 + k, 1 + n});
    for (std::uint32_t i = 0; i + 2 < along; ++i) {
      const std::uint32_t a = 1 + i * around, b = a + around;
      mesh.triangles.push_back({a + k, b + k, b + n});
      mesh.triangles.push_back({a + k, b + n, a + n});
    }
    const std::uint32_t ring = last - around;
    mesh.triangles.push_back({ring + k, last, ring + n});
  }
  return mesh;
}

}  // namespace

TEST_CASE("a tube beside, touching, piercing and inside a ball") {
  const TriangleMesh mesh = ball(64, 32);
  CHECK(mesh.volume() == doctest::Approx(4.0 / 3 * 3.14159).epsilon(0.02));
  Obstacle obstacle(mesh.positions, mesh.triangles);
  const Bezier tubes[] = {test::straight({-1, 1.2f, 0}, {1, 1.2f, 0}, 0.1f),
                          test::straight({-1, 1.05f, 0}, {1, 1.05f, 0}, 0.1f),
                          test::straight({0, 0, 0.5f}, {0, 0, 2}, 0.1f),
                          test::straight({-0.02f, 0.9f, 0}, {0.02f, 0.9f, 0}, 0.02f)};
  const auto contacts = obstacle.contacts(tubes, 0, 0.6f);
  float deepest[4] = {1, 1, 1, 1};
  for (const ObstacleContact& contact : contacts) {
    const vec4 at = tubes[contact.tube].at(contact.s);
    CHECK(glm::length(contact.normal) == doctest::Approx(1));
    CHECK(glm::dot(contact.normal, contact.point) > 0);
    CHECK(contact.f == doctest::Approx(glm::length(vec3(at)) - 1 - at.w).epsilon(0.01).scale(1));
    deepest[contact.tube] = std::min(deepest[contact.tube], contact.f);
  }
  CHECK(deepest[0] == 1);
  CHECK(deepest[1] == doctest::Approx(-0.05).epsilon(0.005).scale(1));
  CHECK(deepest[2] == doctest::Approx(-0.6).epsilon(0.01).scale(1));
  CHECK(deepest[3] == doctest::Approx(-0.12).epsilon(0.005).scale(1));
  CHECK(obstacle.contacts({tubes, 1}, 0.15f, 0).size() > 0);
}

TEST_CASE("the obstacle follows its vertices") {
  const TriangleMesh mesh = ball(32, 16);
  Obstacle obstacle(mesh.positions, mesh.triangles);
  const Bezier tube[] = {test::straight({4.5f, 0, 0}, {4.5f, 0, 1}, 0.1f)};
  CHECK(obstacle.contacts(tube, 0, 0.5f).empty());
  auto moved = mesh.positions;
  for (vec3& p : moved) p += vec3(3.5f, 0, 0);
  obstacle.update(moved);
  const auto contacts = obstacle.contacts(tube, 0, 0.5f);
  REQUIRE(!contacts.empty());
  CHECK(contacts[0].normal.x == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("random tubes: a contact wherever dense sampling finds one, whatever the thread count") {
  const TriangleMesh mesh = ball(48, 24);
  Obstacle obstacle(mesh.positions, mesh.triangles);
  auto tubes = test::randomTubes(300, 8, 2.4f, 0.6f, 0.06f);
  for (Bezier& tube : tubes)
    for (vec4& p : tube.b) p -= vec4(1.2f, 1.2f, 1.2f, 0);
  std::uint64_t first = 0;
  for (const unsigned threads : {1u, 2u, 8u}) {
    setThreadCount(threads);
    const auto contacts = obstacle.contacts(tubes, 0, 1.0f);
    std::vector<float> facts;
    std::vector<float> deepest(tubes.size(), 1);
    for (const ObstacleContact& c : contacts) {
      facts.insert(facts.end(), {float(c.tube), float(c.triangle), c.s, c.f});
      deepest[c.tube] = std::min(deepest[c.tube], c.f);
    }
    if (threads == 1) first = hashOf<float>(facts);
    CHECK(hashOf<float>(facts) == first);
    for (std::size_t i = 0; i < tubes.size(); ++i) {
      float sampled = 1;
      for (int k = 0; k <= 200; ++k) {
        const vec4 at = tubes[i].at(float(k) / 200);
        sampled = std::min(sampled, glm::length(vec3(at)) - 1 - at.w);
      }
      if (std::abs(sampled) > 0.03f) CHECK((deepest[i] < 0) == (sampled < 0));
      if (sampled < -0.03f) CHECK(deepest[i] == doctest::Approx(sampled).epsilon(0.03).scale(1));
    }
  }
  setThreadCount(0);
}

TEST_CASE("no triangles, no contacts") {
  Obstacle nothing({}, {});
  CHECK(nothing.contacts(test::randomTubes(3, 1, 1, 1, 1), 0, 1).empty());
  CHECK(nothing.triangleCount() == 0);
}
