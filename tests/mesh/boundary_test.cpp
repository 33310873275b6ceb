#include "mesh/boundary.h"

#include <doctest/doctest.h>

#include "support/tubes.h"

using namespace vasa;

TEST_CASE("edges of two triangles, and a third on the same edge") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 2, 4}};
  const MeshEdges edges = buildEdges(mesh);
  CHECK(edges.size() == 7);
  CHECK(edges.vertices[0] == uvec2(0, 1));
  CHECK(edges.trianglesOf(edges.ofTriangle[0][1]).size() == 3);  // edge 1-2
  CHECK(edges.trianglesOf(edges.ofTriangle[0][0]).size() == 1);
  CHECK(buildVertexTriangles(mesh).of(1).size() == 3);
}

TEST_CASE("an open tube has two loops; filled, it is closed and has its volume") {
  const TriangleMesh tube = test::straightTube(0.1f, 0.01f, test::TubeEnds::open);
  const MeshEdges edges = buildEdges(tube);
  const auto loops = boundaryLoops(tube, edges);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].vertices.size() == 16);
  const TriangleMesh filled = fillLoops(tube, edges, loops);
  CHECK(boundaryLoops(filled, buildEdges(filled)).empty());
  CHECK(filled.volume() == doctest::Approx(test::straightTube(0.1f, 0.01f).volume()).epsilon(1e-5));
}

TEST_CASE("a missing triangle is filled by one triangle; loops that touch are taken apart") {
  TriangleMesh tube = test::straightTube(0.1f, 0.01f);
  const std::size_t whole = tube.triangles.size();
  const double volume = tube.volume();
  // Opposite triangles around one vertex: two holes that share it.
  std::vector<uvec3> kept;
  const VertexTriangles around = buildVertexTriangles(tube);
  const std::uint32_t a = around.of(100)[0];
  std::uint32_t b = a;
  for (const std::uint32_t t : around.of(100)) {
    int shared = 0;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) shared += tube.triangles[t][k] == tube.triangles[a][l];
    if (shared == 1) b = t;
  }
  REQUIRE(b != a);
  for (std::uint32_t t = 0; t < tube.triangles.size(); ++t)
    if (t != a && t != b) kept.push_back(tube.triangles[t]);
  tube.triangles = kept;
  const MeshEdges edges = buildEdges(tube);
  const auto loops = boundaryLoops(tube, edges);
  REQUIRE(loops.size() == 2);
  const TriangleMesh filled = fillLoops(tube, edges, loops);
  CHECK(filled.triangles.size() == whole);
  CHECK(filled.volume() == doctest::Approx(volume).epsilon(1e-6));
}
