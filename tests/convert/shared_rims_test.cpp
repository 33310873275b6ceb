#include "convert/shared_rims.h"

#include <doctest/doctest.h>

#include <limits>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

namespace {

constexpr float kRadius = 0.003f;

TriangleMesh along(float from, float to) {
  return tubeBetween({0, 0, from}, {0, 0, to}, kRadius, TubeEnds::open, 10);
}

/// Every triangle with vertices of its own, as STL has them.
TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const uvec3& t : mesh.triangles) {
    const auto first = std::uint32_t(result.positions.size());
    for (const std::uint32_t v : {t.x, t.y, t.z}) result.positions.push_back(mesh.positions[v]);
    result.triangles.push_back(uvec3(first, first + 1, first + 2));
  }
  return result;
}

}  // namespace

TEST_CASE(
    "two parts of one surface share the rim along which it was divided, as triangles of their own too") {
  for (const TriangleMesh& second : {along(0.02f, 0.05f), soup(along(0.02f, 0.05f))}) {
    const std::vector<SourceElement> elements{source("first", along(0, 0.02f)), source("second", second),
                                              source("third", along(0.1f, 0.2f))};
    const auto rims = sharedRims(elements);
    REQUIRE(rims.size() == 1);
    CHECK(rims[0].first == 0);
    CHECK(rims[0].second == 1);
    CHECK(glm::distance(rims[0].centre, vec3(0, 0, 0.02f)) < 1e-6f);
    CHECK(rims[0].radius == doctest::Approx(kRadius).epsilon(1e-3));
  }
}

TEST_CASE("what is not finite, and what more elements have than meet anywhere, is passed over in time") {
  TriangleMesh broken = along(0.02f, 0.05f);
  broken.positions.back().y = std::numeric_limits<float>::quiet_NaN();
  CHECK(sharedRims(std::vector{source("first", along(0, 0.02f)), source("broken", broken)}).size() == 1);

  const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  CHECK(sharedRims(std::vector<SourceElement>(20000, source("same", triangle))).empty());
}

TEST_CASE("surfaces that share two rims tell both; a micrometre apart, or in one corner, none") {
  TriangleMesh ends = along(-0.02f, 0);
  const TriangleMesh far = along(0.02f, 0.05f);
  const auto shift = std::uint32_t(ends.positions.size());
  ends.positions.insert(ends.positions.end(), far.positions.begin(), far.positions.end());
  for (const uvec3& t : far.triangles) ends.triangles.push_back(t + shift);
  CHECK(sharedRims(std::vector{source("middle", along(0, 0.02f)), source("ends", ends)}).size() == 2);

  TriangleMesh apart = along(0.02f, 0.05f);
  for (vec3& p : apart.positions) p.z += 1e-6f;
  CHECK(sharedRims(std::vector{source("first", along(0, 0.02f)), source("apart", apart)}).empty());

  TriangleMesh corner = along(0.1f, 0.2f);
  corner.positions.front() = along(0, 0.02f).positions.back();
  CHECK(sharedRims(std::vector{source("first", along(0, 0.02f)), source("corner", corner)}).empty());
}
