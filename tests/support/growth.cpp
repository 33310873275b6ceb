#include "support/growth.h"

#include <doctest/doctest.h>

#include "growth/random.h"

namespace vasa::test {

const std::string& growthText() {
  static const std::string text = R"(# two systems
system oak
axiom S
root share 0.3 thickest_mm 5 lean 60
tips count 3 spread 40
draw S length 20~0.3 taper 0.6 meander 0.4 hug 0.3 outward 0.1 along 0.1 fibre 0.2 curl 0.2
S -> F [@0.3 &45~10 /0~30 T] [@0.6 &40 /137.5 "0.8 T] [@1 &20 /90~90 !2 S] [@1 &30 /270~90 T]
draw T length 15 taper 0.7 curl 0.5
T -> F [@0.5 &50 /180 T] [@1 &10 /0 T]
system reed
axiom A
root share 0.5 thickest_mm 8 lean 30
draw A length 10 taper 1
A -> F [@1 &25 /0 A] [@1 &25 /180 A]
)";
  return text;
}

GrownNetwork::GrownNetwork(Network chosen)
    : network(std::move(chosen)),
      table(makeSweepTable(network)),
      points(network.points().begin(), network.points().end()),
      frames(table.knotCount),
      rules([] {
        auto read = parseGrowthRules(growthText(), "test");
        REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.error().message));
        return std::move(*read);
      }()) {
  pose();
  sites.spans = wholeSpans(network);
  const std::size_t count = sites.spans.size();
  for (std::uint32_t span = 0; span < count; ++span) {
    const float way = 0.02f * float(1 + span % 5);
    sites.sites.push_back({.hub = vec3(way, -0.03f, 0.01f),
                           .reach = 1 + way,
                           .axis = glm::normalize(vec3(0.2f, way, 1)),
                           .system = span % 2 | (span % 3 == 0 ? 0x100u : 0u),
                           .wall = {},
                           .stretch = {span % 4 == 1 ? 0.25f : 0, 1},
                           .key = keyOf(3, span),
                           .sprouts = span % 4 == 0 ? 0 : 3 + span % 7,
                           .partner = shared::kNoPartner});
    if (span % 3 == 1) sites.sites.back().wall[2] = vec4(glm::normalize(vec3(1, 2, way)), 0.05f + way);
    if (span % 5 == 2) sites.sites.back().partner = span - 1;
  }
  sites.freeEnds.resize(count);
  sites.region.assign(count, 0);
  for (const CapEnd& cap : table.caps) {
    std::uint8_t& ends = sites.freeEnds[table.spanOfSweep[cap.sweep]];
    ends = std::uint8_t(ends | (cap.last ? 2u : 1u));
  }
}

void GrownNetwork::pose() { networkFrames(network, points, restReferences(network), frames); }

}  // namespace vasa::test
