#include "convert/unfold.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("what was pushed over in a wall is unfolded, and the rest of it stays") {
  TriangleMesh mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.004f, TubeEnds::open);
  REQUIRE(foldedTriangles(mesh).empty());
  const TriangleMesh before = mesh;
  const uvec3 pushed = mesh.triangles[mesh.triangles.size() / 2];
  const vec3 over = mesh.positions[pushed.y] - mesh.positions[pushed.x];
  for (const std::uint32_t v : {pushed.x, pushed.z}) mesh.positions[v] += 1.7f * over;
  REQUIRE(foldedTriangles(mesh).size() >= 2);
  CHECK(unfold(mesh, {}) == 0);
  CHECK(foldedTriangles(mesh).empty());
  std::size_t moved = 0;
  float farthest = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float way = glm::distance(mesh.positions[i], before.positions[i]);
    moved += way > 0;
    farthest = std::max(farthest, way);
  }
  CHECK(moved < 40);
  CHECK(farthest < 2 * glm::length(over));
}

TEST_CASE("vertices on a wall's loops are not moved, and what cannot be unfolded is counted") {
  TriangleMesh mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.004f, TubeEnds::open);
  const uvec3 pushed = mesh.triangles[mesh.triangles.size() / 2];
  mesh.positions[pushed.x] += 2.5f * (mesh.positions[pushed.y] - mesh.positions[pushed.x]);
  const TriangleMesh before = mesh;
  const std::size_t folded = foldedTriangles(mesh).size();
  REQUIRE(folded > 0);
  CHECK(unfold(mesh, vertexNormals(mesh)) == folded);
  CHECK(mesh.positions == before.positions);
}

TEST_CASE("triangles that look against normals which are held fold, and their other corners give way") {
  TriangleMesh mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.004f, TubeEnds::open);
  std::vector<vec3> held = vertexNormals(mesh);
  held.resize(mesh.positions.size() / 2);
  CHECK(foldedTriangles(mesh, held).empty());
  for (vec3& normal : held) normal = -normal;
  CHECK(!foldedTriangles(mesh, held).empty());
  const TriangleMesh before = mesh;
  unfold(mesh, held);
  const auto ends = std::ptrdiff_t(held.size());
  CHECK(std::equal(mesh.positions.begin(), mesh.positions.begin() + ends, before.positions.begin()));
  CHECK(mesh.positions != before.positions);
}
