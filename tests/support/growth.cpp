#include "support/growth.h"

#include <doctest/doctest.h>

#include <glm/gtc/quaternion.hpp>

namespace vasa::test {

const std::string& growthText() {
  static const std::string text = R"(# two systems
system oak
axiom S
root radius 0.02 share 0.5
draw S taper 0.6 meander 0.2
S -> F [@0.3 T] [@0.6 T] [@1 !2 S] [@1 T]
draw T taper 0.7 fibre 0.5
T -> F [@0.5 T] [@1 T]
system reed
axiom A
root radius 0.03
draw A taper 1
A -> F [@1 A] [@1 A]
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
  beds.spans = wholeSpans(network);
  for (std::uint32_t span = 0; span < beds.spans.size(); ++span) {
    const float way = 0.01f * float(1 + span % 5);
    const quat turn = glm::angleAxis(0.7f * float(span % 9), glm::normalize(vec3(1, way, 0.5f)));
    shared::GrowthBed bed{};
    bed.centre = vec3(2 * way, -0.03f, way);
    bed.span = span;
    bed.t = 0.3f + 0.1f * float(span % 4);
    bed.middle = vec3(0.1f, -0.2f, 0);
    bed.entry = vec3(-1.5f, 0.5f, way);
    bed.system = span % 2;
    for (int a = 0; a < 3; ++a) {
      vec3 axis(0);
      axis[a] = 1;
      bed.side[a] = vec4(turn * axis, 0.02f - 0.004f * float(a));
    }
    if (span % 3 == 1) bed.wall[2] = vec4(glm::normalize(vec3(1, 2, way)), 0.005f);
    if (span % 2) bed.surface = vec4(glm::normalize(vec3(way, 1, 0.3f)), 0.01f);
    for (const std::uint32_t side : {0u, 1u}) {
      shared::GrowthStem& stem = bed.stem[side];
      stem.span = span;
      stem.t = 0.2f + 0.5f * float(side);
      stem.leaving = glm::normalize(vec3(0.5f, -0.2f, side ? 1 : -1));
      stem.radius = 0.001f;
      stem.last = 0.0007f;
      stem.own = 0.0006f;
      stem.end = vec3(side ? 0.003f : -0.003f, 0.001f, 0);
      stem.through = glm::normalize(vec3(0.3f, 1, way));
      stem.from = span % 7 == 6 && side ? shared::kNoStem : shared::kFromVessel;
      if (span % 4 == 3 && beds.beds.back().stem[side].from != shared::kNoStem)
        stem.from = span - 1, stem.span = beds.beds.back().stem[side].span;
    }
    beds.beds.push_back(bed);
  }
  beds.regionOfBed.assign(beds.beds.size(), 0);
  beds.regionOfSpan.assign(beds.spans.size(), 0);
}

void GrownNetwork::pose() { networkFrames(network, points, restReferences(network), frames); }

}  // namespace vasa::test
