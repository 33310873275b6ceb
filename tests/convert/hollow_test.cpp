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

// Outside, rim, inside and rim as one surface of revolution about y; `blind`: closed at the far end.
TriangleMesh rimmed(bool blind) {
  std::vector<vec2> profile;  // radius and height
  const auto add = [&](float radius, float from, float to) {
    for (int k = 0; k <= 40; ++k) profile.push_back({radius, glm::mix(from, to, float(k) / 40)});
  };
  add(0.012f, 0, 0.3f);
  if (blind) profile.insert(profile.end(), {{0.006f, 0.3f}, {0, 0.3f}, {0, 0.297f}, {0.005f, 0.297f}});
  add(0.010f, blind ? 0.297f : 0.3f, 0);
  constexpr std::uint32_t kAround = 24;
  TriangleMesh mesh;
  for (const vec2 at : profile)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const float angle = 6.2831853f * float(k) / kAround;
      mesh.positions.push_back({at.x * std::cos(angle), 1 + at.y, -at.x * std::sin(angle)});
    }
  const auto rows = std::uint32_t(profile.size());
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = row * kAround + k, b = row * kAround + (k + 1) % kAround,
                          c = (row + 1) % rows * kAround + k,
                          d = (row + 1) % rows * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
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

TEST_CASE("a printed phantom, whose wall goes on around its rims, is as wide as its lumen") {
  for (const bool blind : {false, true}) {
    const TriangleMesh phantom = rimmed(blind);
    const auto left = withoutOuterWalls(phantom, 1e-5f);
    REQUIRE(left);
    CHECK(left->area() ==
          doctest::Approx(tubeBetween(kFrom, kTo, 0.010f, TubeEnds::open).area()).epsilon(0.1));
    const auto conversion = convertElements(std::vector{source("aorta", phantom)});
    REQUIRE(conversion);
    REQUIRE(conversion->network.vessels().size() == 1);
    CHECK(radiusOf(conversion->network) == doctest::Approx(0.010).epsilon(0.03));
    CHECK(conversion->report.elements.front().coverage > 0.95f);
  }
}

TEST_CASE("a vessel bent so that it looks at itself has no inside") {
  const auto arch = [](float t) {
    const float angle = 3.0f * t;
    return 0.02f * vec3(std::cos(angle), std::sin(angle), 0);
  };
  for (const TubeEnds ends : {TubeEnds::open, TubeEnds::flat})
    CHECK(!withoutOuterWalls(tube(
                                 arch, [](float) { return 0.008f; }, 60, 24, ends),
                             1e-5f));
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

TEST_CASE(
    "a wall that is an element of its own is left out where its lumen is another one, and that is said") {
  const std::vector<SourceElement> elements{
      source("wall", tubeBetween(kFrom, kTo, 0.012f, TubeEnds::open), VesselKind::other),
      source("aorta", tubeBetween(kFrom, kTo, 0.010f, TubeEnds::open))};
  CHECK(outerWalls(elements) == std::vector{true, false});
  const auto conversion = convertElements(elements);
  REQUIRE(conversion);
  CHECK(conversion->outerWalls == std::vector<std::string>{"wall"});
  REQUIRE(conversion->network.vessels().size() == 1);
  CHECK(conversion->network.vessels()[0].kind == VesselKind::artery);
  CHECK(radiusOf(conversion->network) == doctest::Approx(0.010).epsilon(0.03));
  CHECK(conversion->report.elements.size() == 1);
}

TEST_CASE("what lies in a vessel and is no lumen of it leaves it as it is") {
  const auto walls = [](const TriangleMesh& inner, VesselKind kind = VesselKind::other) {
    return outerWalls(
        std::vector{source("aorta", tubeBetween(kFrom, kTo, 0.012f)), source("inner", inner, kind)});
  };
  const std::vector<bool> none(2);
  CHECK(walls(tubeBetween(kFrom, kTo, 0.002f)) == none);                         // a catheter
  CHECK(walls(tubeBetween(kFrom, glm::mix(kFrom, kTo, 0.5f), 0.010f)) == none);  // a stent graft
  CHECK(walls(tubeBetween(kFrom, kTo, 0.012f)) == none);                         // a copy
  CHECK(walls(tube([](float t) { return glm::mix(kFrom, kTo, t); }, [](float) { return 0.012f; }, 8, 6,
                   TubeEnds::flat)) == none);  // a coarser one, inside but for its corners
  CHECK(walls(tubeBetween(kFrom, kTo, 0.010f), VesselKind::vein) == none);
  TriangleMesh rings;  // of a stent
  for (int i = 1; i < 20; ++i) {
    const vec3 at = glm::mix(kFrom, kTo, float(i) / 20);
    append(rings, tube(
                      [=](float t) {
                        return at + 0.0105f * vec3(std::cos(6.2831853f * t), 0, std::sin(6.2831853f * t));
                      },
                      [](float) { return 0.0005f; }, 40, 8, TubeEnds::open));
  }
  CHECK(walls(rings) == none);
}
