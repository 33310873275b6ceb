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
