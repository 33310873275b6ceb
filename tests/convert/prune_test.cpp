#include "convert/prune.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

// Points from a (left out) to b (left out), 1 mm apart, all of one radius.
AxisChain chain(std::uint32_t start, std::uint32_t end, vec3 a, vec3 b, float radius) {
  AxisChain result{start, end, {}, glm::distance(a, b)};
  const int count = std::max(1, int(result.length / 0.001f) - 1);
  for (int i = 1; i <= count; ++i)
    result.points.push_back(vec4(glm::mix(a, b, float(i) / float(count + 1)), radius));
  return result;
}

}  // namespace

TEST_CASE("a stub shorter than its parent's radius goes, and the parent is one chain again") {
  AxisGraph graph;
  graph.nodes = {{0, 0, 0}, {0.05f, 0, 0}, {0.1f, 0, 0}, {0.05f, 0.004f, 0}};
  graph.chains = {chain(0, 1, graph.nodes[0], graph.nodes[1], 0.005f),
                  chain(2, 1, graph.nodes[2], graph.nodes[1], 0.005f),
                  chain(1, 3, graph.nodes[1], graph.nodes[3], 0.002f)};
  CHECK(prune(graph, 1e-4f).pruned == 1);
  REQUIRE(graph.chains.size() == 1);
  CHECK(graph.nodes.size() == 2);
  const auto& points = graph.chains[0].points;
  for (std::size_t i = 1; i < points.size(); ++i)
    CHECK((points[i].x - points[i - 1].x) * (points[1].x - points[0].x) > 0);
  CHECK(graph.chains[0].length == doctest::Approx(0.1));
}

TEST_CASE("a long side branch stays; two forks nearer than the radius become one of four") {
  AxisGraph graph;
  graph.nodes = {{0, 0, 0},    {0.05f, 0, 0},     {0.053f, 0, 0},
                 {0.1f, 0, 0}, {0.05f, 0.04f, 0}, {0.053f, -0.04f, 0}};
  graph.chains = {chain(0, 1, graph.nodes[0], graph.nodes[1], 0.005f),
                  chain(1, 2, graph.nodes[1], graph.nodes[2], 0.005f),
                  chain(2, 3, graph.nodes[2], graph.nodes[3], 0.005f),
                  chain(1, 4, graph.nodes[1], graph.nodes[4], 0.002f),
                  chain(2, 5, graph.nodes[2], graph.nodes[5], 0.002f)};
  const PruneReport report = prune(graph, 1e-4f);
  CHECK(report.pruned == 0);
  CHECK(report.merged == 1);
  CHECK(graph.chains.size() == 4);
  CHECK(graph.nodes.size() == 5);
}

TEST_CASE("a loop around a hole closes, a loop of vessels stays") {
  const auto twoWays = [](float width) {
    AxisGraph graph;
    graph.nodes = {{0, 0, 0}, {0.05f, 0, 0}, {0.05f + width, 0, 0}, {0.15f, 0, 0}};
    graph.chains = {chain(0, 1, graph.nodes[0], graph.nodes[1], 0.004f),
                    chain(1, 2, graph.nodes[1], graph.nodes[2], 0.003f),
                    chain(1, 2, graph.nodes[1], graph.nodes[2], 0.002f),
                    chain(2, 3, graph.nodes[2], graph.nodes[3], 0.004f)};
    return graph;
  };
  AxisGraph small = twoWays(0.008f);
  CHECK(prune(small, 1e-4f).loops == 1);
  CHECK(small.chains.size() == 1);
  AxisGraph large = twoWays(0.06f);
  CHECK(prune(large, 1e-4f).loops == 1);  // long, but both ways in one place: the strips of a slit tube
  large = twoWays(0.06f);
  for (vec4& p : large.chains[1].points) p.y += 0.02f;
  CHECK(prune(large, 1e-4f).loops == 0);
  CHECK(large.chains.size() == 4);
}

TEST_CASE("an empty graph and a single ring survive") {
  AxisGraph none;
  prune(none, 1e-4f);
  CHECK(none.chains.empty());
  AxisGraph ring;
  ring.nodes = {{0, 0, 0}};
  ring.chains = {chain(0, 0, {0, 0, 0}, {0.001f, 0, 0}, 0.01f)};
  prune(ring, 1e-4f);
  CHECK(ring.chains.size() == 1);
}
