// Surfaces that fell to splinters: what is told of them, and that they take no more than their triangles
// tell.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "convert/convert.h"
#include "convert/sources.h"
#include "convert/span_limit.h"
#include "convert/strand_fit.h"
#include "curve/bspline.h"

using namespace vasa;
using namespace vasa::test;

namespace {

class Random {
 public:
  vec3 within(float size) { return {signedUnit() * size, signedUnit() * size, signedUnit() * size}; }

 private:
  float signedUnit() {
    return 2 * float(engine_() - engine_.min()) / float(engine_.max() - engine_.min()) - 1;
  }
  std::minstd_rand engine_{7};
};

void addRibbon(TriangleMesh& mesh, vec3 from, vec3 to, vec3 across) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {from, from + across, to, to + across});
  mesh.triangles.insert(mesh.triangles.end(),
                        {{first, first + 1, first + 2}, {first + 1, first + 3, first + 2}});
}

// A tube of three sides that goes to and fro in a room.
void addZigzag(TriangleMesh& mesh, Random& random, int legs, float radius, float room) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int leg = 0; leg <= legs; ++leg) {
    const vec3 middle = random.within(room);
    for (int side = 0; side < 3; ++side)
      mesh.positions.push_back(middle +
                               radius * vec3(std::cos(2.1f * float(side)), std::sin(2.1f * float(side)), 0));
  }
  for (std::uint32_t leg = 0; leg < std::uint32_t(legs); ++leg)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t a = first + 3 * leg + side, b = first + 3 * leg + (side + 1) % 3;
      mesh.triangles.emplace_back(a, b, b + 3);
      mesh.triangles.emplace_back(a, b + 3, a + 3);
    }
}

}  // namespace

TEST_CASE("what strands ask for is cut to what is allowed, the greediest first") {
  constexpr auto kUnlimited = std::numeric_limits<std::uint32_t>::max();
  CHECK(spanLimit({}, 10) == kUnlimited);
  CHECK(spanLimit({3, 4, 3}, 10) == kUnlimited);
  CHECK(spanLimit({3, 100, 3}, 10) == 4);
  CHECK(spanLimit({1, 100, 50}, 11) == 5);
  CHECK(spanLimit({7, 7, 7}, 2) == 1);  // a vessel has one at the least
}

TEST_CASE("a strand takes no more spans than it may, and keeps its ends") {
  Random random;
  Sections sections;
  for (int i = 0; i < 1000; ++i) sections.push_back(vec4(random.within(0.5f), 0.001f));
  const auto points = fitStrand(sections, {.mostSpans = 20});
  CHECK(spanCount(points) <= 20);
  CHECK(glm::distance(points.front(), sections.front()) < 1e-6f);
  CHECK(glm::distance(points.back(), sections.back()) < 1e-6f);
}

TEST_CASE("a surface that fell to pieces of two triangles is refused as torn") {
  Random random;
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i)
    addRibbon(mesh, random.within(0.6f), random.within(0.6f), random.within(0.002f));
  const auto made = convertElements(std::vector<SourceElement>{source("torn", mesh)});
  REQUIRE(!made.ok());
  CHECK(made.error().fault == Fault::badInput);
  CHECK(made.error().message.find("pieces of one or two triangles") != std::string::npos);
  CHECK(made.error().message.find("merge the vertices") != std::string::npos);
}

TEST_CASE("splinters are left out beside what is whole") {
  TriangleMesh mesh = tubeBetween({0, 1, 0}, {0, 1.3f, 0}, 0.01f);
  for (int i = 0; i < 5; ++i)
    addRibbon(mesh, {0.1f * float(i), 0, 0}, {0.1f * float(i), 0.2f, 0}, {0.005f, 0, 0});
  const auto made = convertElements(std::vector<SourceElement>{source("artery", mesh)});
  REQUIRE(made.ok());
  CHECK(made->network.vessels().size() == 1);
  CHECK(made->report.elements[0].reason.find("5 pieces of one or two triangles") != std::string::npos);
}

TEST_CASE("long thin splinters take no more sweeps than their triangles tell") {
  Random random;
  TriangleMesh mesh;
  for (int i = 0; i < 30; ++i) addZigzag(mesh, random, 4, 0.001f, 0.6f);  // 150 sweeps a leg, by their length
  const auto made = convertElements(std::vector<SourceElement>{source("splinters", mesh)});
  REQUIRE(made.ok());
  CHECK(made->report.summary.sweeps > 100);
  CHECK(made->report.summary.sweeps <= spansToldBy(mesh.triangles.size()));
}

TEST_CASE("what asks for more than its triangles tell pays for it alone") {
  Random random;
  TriangleMesh splinters;
  for (int i = 0; i < 250; ++i) addZigzag(splinters, random, 1, 0.001f, 0.6f);
  const auto wave = [](float t) { return vec3(0.02f * std::sin(40 * t), 1 + 0.3f * t, 0); };
  const SourceElement artery = source("artery", tube(
                                                    wave, [](float) { return 0.001f; }, 60, 6));
  const auto alone = convertElements(std::vector<SourceElement>{artery});
  const auto beside = convertElements(std::vector<SourceElement>{artery, source("splinters", splinters)});
  REQUIRE(alone.ok());
  REQUIRE(beside.ok());
  const auto sweepsOf = [](const Conversion& made) {
    std::size_t sweeps = 0;
    for (const Vessel& vessel : made.network.vessels())
      if (vessel.name.starts_with("artery")) sweeps += vessel.spanCount();
    return sweeps;
  };
  CHECK(sweepsOf(*alone) > 12);  // more than a share of all alike
  CHECK(sweepsOf(*beside) == sweepsOf(*alone));
}
