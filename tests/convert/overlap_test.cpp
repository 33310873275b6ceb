#include "convert/overlap.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("what a longer vessel tells is dropped or cut back") {
  StrandGraph graph;
  const auto add = [&](std::uint32_t element, vec3 a, vec3 b, float radius) {
    return graph.add({sectionsBetween(a, b, radius), element, VesselKind::artery});
  };
  const auto whole = add(0, {0, 0, 0}, {0, 0.3f, 0}, 0.008f);
  const auto part = add(1, {0.001f, 0.1f, 0}, {0.001f, 0.2f, 0}, 0.007f);
  const auto beyond = add(2, {0, 0.25f, 0}, {0, 0.4f, 0}, 0.008f);
  const auto across = add(3, {-0.01f, 0.15f, 0}, {0.05f, 0.15f, 0}, 0.004f);
  const auto thin = add(4, {0, 0.05f, 0}, {0, 0.25f, 0}, 0.001f);
  const auto absorbed = removeOverlaps(graph);
  REQUIRE(absorbed.size() == 1);
  CHECK(absorbed[0].element == 1);
  CHECK(absorbed[0].into == 0);
  CHECK(graph.strands[part].dropped());
  CHECK(graph.strands[beyond].sections.front().y == doctest::Approx(0.3f).epsilon(0.02));
  CHECK(lengthOf(graph.strands[whole].sections) == doctest::Approx(0.3f));
  CHECK(lengthOf(graph.strands[across].sections) == doctest::Approx(0.06f));
  CHECK(lengthOf(graph.strands[thin].sections) == doctest::Approx(0.2f));
}
