#include "mesh/weld.h"

#include <doctest/doctest.h>

#include <limits>

#include "mesh/components.h"
#include "support/tubes.h"

using namespace vasa;

TEST_CASE("welding joins near vertices and drops what collapses, repeats or is not finite") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},     {1, 0, 0}, {0, 1, 0},
                    {1e-6f, 0, 0}, {1, 1, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0},
                    {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 1}, {2, 3, 1}, {0, 3, 1}, {0, 1, 5}, {0, 1, 77}};
  const TriangleMesh clean = weld(mesh, 1e-5f);
  REQUIRE(clean.positions.size() == 4);
  REQUIRE(clean.triangles.size() ==
          2);  // the third repeats the first, the fourth collapses, 5 and 77 are bad
  CHECK(clean.triangles[0] == uvec3(0, 1, 2));
  CHECK(clean.triangles[1] == uvec3(0, 3, 1));
  CHECK(weld(mesh, 0).positions.size() == 5);
}

TEST_CASE("welding nothing, and far-off coordinates") {
  CHECK(weld({}, 1e-5f).empty());
  TriangleMesh mesh;
  mesh.positions = {{1e30f, 0, 0}, {0, -1e30f, 0}, {0, 0, 3e38f}};
  mesh.triangles = {{0, 1, 2}};
  CHECK(weld(mesh, 1e-6f).triangles.size() == 1);
}

TEST_CASE("an unwelded soup of a tube becomes the tube again") {
  const TriangleMesh tube = test::straightTube(0.1f, 0.005f);
  TriangleMesh soup;
  for (const uvec3& t : tube.triangles)
    for (int k = 0; k < 3; ++k) {
      if (k == 0) soup.triangles.push_back(uvec3(0, 1, 2) + std::uint32_t(soup.positions.size()));
      soup.positions.push_back(tube.positions[t[k]]);
    }
  const TriangleMesh clean = weld(soup, 1e-6f);
  CHECK(clean.positions.size() == tube.positions.size());
  CHECK(clean.triangles.size() == tube.triangles.size());
}

TEST_CASE("components hang together by vertices, in the order of their first triangles") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 0, 0},
                    {0, -1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {6, 7, 8}, {0, 4, 5}, {1, 3, 2}};
  const auto parts = splitComponents(mesh);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].triangles.size() == 3);
  CHECK(parts[0].positions.size() == 6);
  CHECK(parts[1].positions[0] == vec3(5, 0, 0));
}
