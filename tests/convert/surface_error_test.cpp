#include "convert/surface_error.h"

#include <doctest/doctest.h>

#include "convert/sources.h"
#include "convert/tube_tree.h"

using namespace vasa;
using namespace vasa::test;

namespace {

Assembly assembled(StrandGraph graph, const std::vector<SourceElement>& elements) {
  auto assembly = assembleNetwork(std::move(graph), elements, {}, 1.7f);
  REQUIRE(assembly.ok());
  return std::move(*assembly);
}

}  // namespace

TEST_CASE("a tube measured against one that is a millimetre thicker") {
  StrandGraph graph;
  graph.add({sectionsBetween({0, 0, 0}, {0, 0.1f, 0}, 0.006f), 0, VesselKind::artery});
  const std::vector<SourceElement> elements{
      source("a", tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.005f, TubeEnds::open))};
  const auto errors = measureSurfaceErrors(assembled(std::move(graph), elements), elements, {});
  const auto forward = statisticsOf(std::span(&errors[0].forward, 1)),
             backward = statisticsOf(std::span(&errors[0].backward, 1));
  CHECK(forward.mean == doctest::Approx(0.001f).epsilon(0.05));
  CHECK(forward.p95 == doctest::Approx(0.001f).epsilon(0.1));
  CHECK(backward.mean == doctest::Approx(0.001f).epsilon(0.05));
  CHECK(errors[0].coverage == 1);  // 20 % of the radius is more than the error
}

TEST_CASE(
    "coverage is the share of the mesh near a wall; an element without vessels is measured against its stand-in") {
  StrandGraph graph;
  graph.add({sectionsBetween({0, 0, 0}, {0, 0.05f, 0}, 0.005f), 0, VesselKind::artery});
  const auto mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.005f, TubeEnds::open);
  const std::vector<SourceElement> elements{source("half", mesh), source("again", mesh),
                                            source("alone", mesh)};
  const std::vector<std::vector<std::uint32_t>> standIns{{}, {0}, {}};
  const auto errors = measureSurfaceErrors(assembled(std::move(graph), elements), elements, standIns);
  CHECK(errors[0].coverage == doctest::Approx(0.55).epsilon(0.06));
  CHECK(errors[1].coverage == doctest::Approx(errors[0].coverage));
  CHECK(errors[2].coverage == 0);
  CHECK(!statisticsOf(std::span(&errors[2].forward, 1)).measured);
}

TEST_CASE("the wall inside a host's lumen is no surface") {
  StrandGraph graph;
  const auto trunk = graph.add({sectionsBetween({0, -0.1f, 0}, {0, 0.1f, 0}, 0.01f), 0, VesselKind::artery});
  const auto branch = graph.add({sectionsBetween({0, 0, 0}, {0.05f, 0, 0}, 0.003f), 1, VesselKind::artery});
  const StrandEnd end{branch, false};
  graph.join(trunk, vec3(0), std::span(&end, 1));
  const std::vector<SourceElement> elements{
      source("trunk", tubeBetween({0, -0.1f, 0}, {0, 0.1f, 0}, 0.01f, TubeEnds::open)),
      source("branch", tubeBetween({0.01f, 0, 0}, {0.05f, 0, 0}, 0.003f, TubeEnds::open))};
  const auto errors = measureSurfaceErrors(assembled(std::move(graph), elements), elements, {});
  CHECK(statisticsOf(std::span(&errors[1].backward, 1)).max < 0.0012f);  // else the 10 mm inside would show
}

TEST_CASE("statistics are weighted by area") {
  const WeightedErrors parts[] = {{{1, 1}, 10}, {{2}, 1}};
  const ErrorStatistics s = statisticsOf(parts);
  CHECK(s.mean == doctest::Approx(22.0f / 21));
  CHECK(s.p95 == 1);
  CHECK(s.max == 2);
}

TEST_CASE("walls of tubes: inside, outside, and the vessel asked about left out") {
  std::vector<TubePiece> pieces{{{0, 0, 0, 1}, {0, 10, 0, 1}, 0}, {{5, 0, 0, 2}, {5, 10, 0, 2}, 1}};
  const TubeTree tree(pieces);
  CHECK(tree.nearestWall({0.5f, 5, 0}, 9).distance == doctest::Approx(-0.5f));
  CHECK(tree.nearestWall({3.5f, 5, 0}, 9).vessel == 1);
  CHECK(tree.nearestWall({40, 5, 0}, 9).vessel == kNone);
  CHECK(tree.insideAnother({5, 5, 0}, 0, 0.1f));
  CHECK(!tree.insideAnother({5, 5, 0}, 1, 0.1f));
}
