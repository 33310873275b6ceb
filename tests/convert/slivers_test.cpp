#include "convert/slivers.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("threads go, links and proper side branches stay") {
  StrandGraph graph;
  std::vector<std::uint32_t> strands;
  const auto add = [&](vec3 a, vec3 b, float radius) {
    strands.push_back(graph.add({sectionsBetween(a, b, radius, 5e-4f), 0, VesselKind::artery}));
    return strands.back();
  };
  const auto hang = [&](std::uint32_t strand, std::uint32_t host, vec3 place) {
    const StrandEnd end{strand, false};
    graph.join(host, place, std::span(&end, 1));
  };
  const auto trunk = add({0, 0, 0}, {0, 0.1f, 0}, 0.004f);
  const auto thread = add({0, 0.03f, 0}, {0.01f, 0.03f, 0}, 1e-4f);
  const auto branch = add({0, 0.05f, 0}, {0.05f, 0.05f, 0}, 0.002f);
  const auto link = add({0, 0.07f, 0}, {0.01f, 0.07f, 0}, 1e-4f);  // thin, but something hangs on it
  const auto leaf = add({0.01f, 0.07f, 0}, {0.06f, 0.07f, 0}, 0.002f);
  hang(thread, trunk, {0, 0.03f, 0}), hang(branch, trunk, {0, 0.05f, 0}), hang(link, trunk, {0, 0.07f, 0});
  const StrandEnd meeting[] = {{link, true}, {leaf, false}};
  graph.join(std::nullopt, vec3(0.01f, 0.07f, 0), meeting);
  CHECK(pruneSlivers(graph, strands) == 1);
  CHECK(graph.strands[thread].dropped());
  for (const std::uint32_t kept : {trunk, branch, link, leaf}) CHECK(!graph.strands[kept].dropped());
}
