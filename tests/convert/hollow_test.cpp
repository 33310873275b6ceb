#include "convert/hollow.h"

#include <doctest/doctest.h>

#include "convert/convert.h"
#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

namespace {

const vec3 kFrom(0, 1, 0), kTo(0.02f, 1.3f, 0.01f);

TriangleMesh hollow(TubeEnds ends, float lumen = 0.010f, float outside = 0.012f) {
  TriangleMesh mesh = tubeBetween(kFrom, kTo, outside, ends);
  append(mesh, tubeBetween(glm::mix(kFrom, kTo, 0.005f), glm::mix(kFrom, kTo, 0.995f), lumen, ends));
  return mesh;
}

float radiusOf(const Network& network) { return network.points()[network.points().size() / 2].w; }

}  // namespace

TEST_CASE("a wall with an outside and an inside is one vessel, as wide as its lumen, and that is said") {
  for (const TubeEnds ends : {TubeEnds::open, TubeEnds::flat}) {
    const std::vector<SourceElement> elements{source("aorta", hollow(ends))};
    const auto conversion = convertElements(elements);
    REQUIRE(conversion);
    REQUIRE(conversion->network.vessels().size() == 1);
    CHECK(radiusOf(conversion->network) == doctest::Approx(0.010).epsilon(0.03));
    const ElementReport& report = conversion->report.elements.front();
    CHECK(report.reason.find("lumen") != std::string::npos);
    CHECK(report.coverage > 0.95f);
  }
}

TEST_CASE("a lumen that is turned inside out is found, too, and a thick wall's") {
  TriangleMesh mesh = tubeBetween(kFrom, kTo, 0.002f);
  TriangleMesh lumen = tubeBetween(kFrom, kTo, 0.001f, TubeEnds::open);
  for (uvec3& t : lumen.triangles) std::swap(t.x, t.y);
  append(mesh, lumen);
  const auto left = withoutOuterWalls(mesh, 1e-5f);
  REQUIRE(left);
  CHECK(left->area() == doctest::Approx(lumen.area()).epsilon(1e-3));
}

TEST_CASE("what lies beside another, is inside but short, or lies thin in a wide one stays") {
  CHECK(!withoutOuterWalls(tubeBetween(kFrom, kTo, 0.01f), 1e-5f));
  CHECK(!withoutOuterWalls({}, 1e-5f));
  TriangleMesh beside = tubeBetween(kFrom, kTo, 0.010f);
  append(beside, tubeBetween(kFrom + vec3(0.025f, 0, 0), kTo + vec3(0.025f, 0, 0), 0.008f));
  CHECK(!withoutOuterWalls(beside, 1e-5f));
  TriangleMesh piece = tubeBetween(kFrom, kTo, 0.012f);
  append(piece, tubeBetween(kFrom, glm::mix(kFrom, kTo, 0.5f), 0.010f));
  CHECK(!withoutOuterWalls(piece, 1e-5f));
  CHECK(!withoutOuterWalls(hollow(TubeEnds::flat, 0.003f, 0.012f), 1e-5f));  // a catheter
}

TEST_CASE("of several vessels in one surface each hollow one loses its outside") {
  TriangleMesh mesh = hollow(TubeEnds::open);
  const vec3 aside(0.1f, 0, 0);
  append(mesh, tubeBetween(kFrom + aside, kTo + aside, 0.006f));
  const auto left = withoutOuterWalls(mesh, 1e-5f);
  REQUIRE(left);
  const double area =
      0.99 * tubeBetween(kFrom, kTo, 0.010f, TubeEnds::open).area() + tubeBetween(kFrom, kTo, 0.006f).area();
  CHECK(left->area() == doctest::Approx(area).epsilon(1e-3));
}
