#include "mesh/slice.h"

#include <doctest/doctest.h>

#include "support/tubes.h"

using namespace vasa;

TEST_CASE("the cut of a square prism is the square") {
  const float half = 0.01f;
  const TriangleMesh prism =
      test::tube([](float t) { return vec3(0.2f, 0.3f, t * 0.1f); },
                 [=](float) { return half * std::sqrt(2.0f); }, 5, 4, test::TubeEnds::flat);
  const MeshEdges edges = buildEdges(prism);
  const TriangleTree tree(prism);
  Slicer slicer(prism, edges, tree);
  const auto shape = slicer.section({0.201f, 0.302f, 0.05f}, {0, 0, 1}, 0.1f);
  REQUIRE(shape);
  CHECK(shape->contains);
  CHECK(shape->chord == 0);
  CHECK(shape->radius == doctest::Approx(2 * half / std::sqrt(kPi)));
  CHECK(glm::distance(shape->centre, vec3(0.2f, 0.3f, 0.05f)) < 1e-6f);
  CHECK(shape->perimeter == doctest::Approx(8 * half));
  CHECK(shape->farthest == doctest::Approx(half * std::sqrt(2.0f)));
  CHECK(!slicer.section({0.2f, 0.3f, 0.2f}, {0, 0, 1}, 0.05f));
}

TEST_CASE(
    "a plane through vertices gives one closed contour; beside an inner tube the smallest around the point") {
  TriangleMesh mesh = test::straightTube(0.1f, 0.01f);  // rings every 2.5 mm
  test::append(mesh, test::straightTube(0.1f, 0.004f));
  const MeshEdges edges = buildEdges(mesh);
  const TriangleTree tree(mesh);
  Slicer slicer(mesh, edges, tree);
  const auto& contours = slicer.cut({0, 0, 0.05f}, {0, 0, 1}, 0.05f);
  REQUIRE(contours.size() == 2);
  CHECK(contours[0].closed);
  CHECK(contours[1].closed);
  CHECK(slicer.section({0, 0, 0.05f}, {0, 0, 1}, 0.05f)->radius < 0.0041f);
  CHECK(slicer.section({0.008f, 0, 0.05f}, {0, 0, 1}, 0.05f)->radius > 0.009f);
}

TEST_CASE("a torn ring is closed by its chord; of a strip the hull is taken") {
  TriangleMesh torn = test::straightTube(0.1f, 0.01f, test::TubeEnds::open);
  const auto drop = [&](int from, int count) {
    TriangleMesh mesh = torn;
    std::erase_if(mesh.triangles, [&](const uvec3& t) {
      const int side = int(std::min({t.x % 16, t.y % 16, t.z % 16}));
      return side >= from && side < from + count;
    });
    return mesh;
  };
  // 14 and 6 sides of a 16-gon of radius 10 mm, closed by a chord: areas of the polygon's sectors.
  const float sector = 0.5f * 1e-4f * std::sin(2 * kPi / 16);
  for (const auto& [count, area] :
       {std::pair{2, 14 * sector + 0.5f * 1e-4f * std::sin(2 * 2 * kPi / 16)},
        std::pair{10, 6 * sector - 0.5f * 1e-4f * std::sin(2 * kPi * 10 / 16) * -1}}) {
    const TriangleMesh mesh = drop(3, count);
    const MeshEdges edges = buildEdges(mesh);
    const TriangleTree tree(mesh);
    Slicer slicer(mesh, edges, tree);
    const auto shape = slicer.section({0, 0, 0.051f}, {0, 0, 1}, 0.05f);
    REQUIRE(shape);
    CHECK(kPi * shape->radius * shape->radius == doctest::Approx(area).epsilon(0.02));
  }
}
