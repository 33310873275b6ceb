#include "mesh/level_set.h"

#include <doctest/doctest.h>

#include "support/tubes.h"

using namespace vasa;

TEST_CASE("distance on a flat sheet is the straight distance") {
  TriangleMesh sheet;
  const int n = 20;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) sheet.positions.push_back({float(x), float(y), 0});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const auto i = std::uint32_t(y * (n + 1) + x), w = std::uint32_t(n + 1);
      sheet.triangles.push_back({i, i + 1, i + w + 1});
      sheet.triangles.push_back({i, i + w + 1, i + w});
    }
  const std::uint32_t corner = 0;
  const auto distance = surfaceDistance(sheet, buildVertexTriangles(sheet), {&corner, 1});
  CHECK(distance[n] == doctest::Approx(20));
  for (std::uint32_t i = 0; i < distance.size(); ++i)
    CHECK(distance[i] <= glm::length(sheet.positions[i]) * 1.08f);
  for (std::uint32_t i = 0; i < distance.size(); ++i)
    CHECK(distance[i] >= glm::length(sheet.positions[i]) - 1e-4f);
}

TEST_CASE("from one end of a tube the other end is farthest; what is not connected stays infinite") {
  TriangleMesh tube = test::straightTube(0.2f, 0.01f, test::TubeEnds::open);
  const auto before = std::uint32_t(tube.positions.size());
  test::append(tube, test::straightTube(0.1f, 0.01f));
  const VertexTriangles around = buildVertexTriangles(tube);
  const std::vector<std::uint32_t> ring{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const auto distance = surfaceDistance(tube, around, ring);
  CHECK(distance[farthest(distance)] == doctest::Approx(0.2));
  CHECK(std::isinf(distance[before]));
}
