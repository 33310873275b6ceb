#include "mesh/triangle_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "math/closest_point.h"
#include "support/tubes.h"

using namespace vasa;

TEST_CASE("nearest agrees with looking at every triangle") {
  const TriangleMesh mesh = test::straightTube(0.1f, 0.01f);
  const TriangleTree tree(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-0.05f, 0.15f);
  for (int trial = 0; trial < 100; ++trial) {
    const vec3 p(value(random), value(random), value(random));
    float least = 1e9f;
    for (const uvec3& t : mesh.triangles)
      least = std::min(
          least,
          glm::distance(
              p, closestOnTriangle(p, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]).point));
    const auto found = tree.nearest(p);
    CHECK(found.distance == least);
    CHECK(glm::distance(found.point, p) == doctest::Approx(least));
    CHECK(tree.nearest(p, least * 0.5f).triangle == kNone);
  }
}

TEST_CASE(
    "a ray from within a tube hits it unless it leaves by an end; one from outside where it points at it") {
  const TriangleMesh mesh = test::tube([](float t) { return vec3(0, 0, t); }, [](float) { return 0.1f; }, 10,
                                       48, test::TubeEnds::open);
  const TriangleTree tree(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1, 1);
  int in = 0, out = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const vec3 direction = glm::normalize(vec3(value(random), value(random), value(random)));
    const vec3 from(0.02f, -0.03f, 0.5f);
    // Where it meets the cylinder, not near its ends.
    const float a = direction.x * direction.x + direction.y * direction.y,
                b = from.x * direction.x + from.y * direction.y,
                c = from.x * from.x + from.y * from.y - 0.01f;
    const float z = from.z + direction.z * (-b + std::sqrt(b * b - a * c)) / a;
    if (std::abs(z) < 0.02f || std::abs(z - 1) < 0.02f) continue;
    const bool hits = z > 0 && z < 1;
    CHECK(tree.hits(from, direction, kNone) == hits);
    (hits ? in : out) += 1;
  }
  CHECK(in > 100);
  CHECK(out > 10);
  const vec3 beside(0.3f, 0, 0.5f);
  CHECK(tree.hits(beside, {-1, 0, 0}, kNone));
  CHECK(!tree.hits(beside, {1, 0, 0}, kNone));
  CHECK(!tree.hits(beside, {0, 0, 1}, kNone));
  const auto nearest = tree.nearest({0.09f, 0, 0.52f});
  CHECK(!tree.hits({0.09f, 0, 0.52f}, {1, 0, 0.01f}, nearest.triangle));
}

TEST_CASE("triangles near a plane: every one that crosses it is among them") {
  const TriangleMesh mesh = test::straightTube(0.1f, 0.01f);
  const TriangleTree tree(mesh);
  const vec3 normal = glm::normalize(vec3(0.2f, 0.1f, 1));
  std::vector<std::uint32_t> found;
  tree.nearPlane({0, 0, 0.031f}, normal, 1, found);
  CHECK(std::is_sorted(found.begin(), found.end()));
  std::size_t crossing = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    int above = 0;
    for (int k = 0; k < 3; ++k)
      above += glm::dot(mesh.positions[mesh.triangles[i][k]] - vec3(0, 0, 0.031f), normal) >= 0;
    if (above == 0 || above == 3) continue;
    ++crossing;
    CHECK(std::binary_search(found.begin(), found.end(), i));
  }
  CHECK(crossing > 20);
  const TriangleMesh none;
  CHECK(TriangleTree(none).nearest({0, 0, 0}).triangle == kNone);
}
