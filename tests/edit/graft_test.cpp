#include <doctest/doctest.h>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"
#include "edit/edited.h"
#include "network/builder.h"
#include "network/kinks.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// Pairs of tubes that overlap, neighbours along the network aside.
std::size_t overlaps(const Network& network) {
  const NetworkTubes layout(network);
  std::vector<Bezier> tubes(layout.count());
  layout.shape(network.points(), tubes);
  TubeDetector detector(tubes, layout.neighbours());
  detector.update(tubes);
  return detector.detect().size();
}

}  // namespace

TEST_CASE("a graft runs from vessel to vessel, clear of both, without a kink") {
  const Network before = smallTree();
  const Network after = edited(before, "graft trunk 0.2 far 0.8 2");
  REQUIRE(after.vessels().size() == 5);
  const Vessel& graft = vesselNamed(after, "graft from trunk to far");
  CHECK(after.node(graft.start).host->vessel == VesselId{0});
  CHECK(after.node(graft.end).host->vessel == VesselId{3});
  CHECK(lengthOf(after.pointsOf(graft)) < 0.16f);
  CHECK(leastRadius(after, graft.name) == doctest::Approx(0.002f));
  CHECK(kinkCount(after, after.points()) == 0);
  CHECK(overlaps(after) == 0);
}

TEST_CASE("a graft is led around what lies across its way") {
  const Network wall = smallTree();
  // Seven vessels across the straight way, 6 mm apart: none of them is run through.
  NetworkBuilder builder;
  for (const Vessel& vessel : wall.vessels())
    builder.addVessel({vessel.name, "", vessel.kind},
                      {wall.pointsOf(vessel).begin(), wall.pointsOf(vessel).end()});
  for (int k = 0; k < 7; ++k) {
    std::vector<vec4> bar;
    for (int j = 0; j < 7; ++j)
      bar.emplace_back(-0.035f + 0.01f * float(j), 1.02f, 0.07f + 0.006f * float(k), 0.0015f);
    builder.addVessel({"bar" + std::to_string(k), "", VesselKind::vein}, bar);
  }
  for (const Node& node : wall.nodes())
    builder.addNode(node.host, {wall.ends(node).begin(), wall.ends(node).end()});
  const auto built = builder.build(1.7f);
  REQUIRE(built.ok());
  REQUIRE(overlaps(*built) == 0);
  const Network after = edited(*built, "graft trunk 0.25 far 0.75 1.5 by");
  CHECK(overlaps(after) == 0);
  CHECK(kinkCount(after, after.points()) == 0);
  MESSAGE("length " << 1e3f * lengthOf(pointsOf(after, "by")) << " mm");
}

TEST_CASE("a graft passes the places that it is led through") {
  const Network after = edited(smallTree(), "graft trunk 0.2 far 0.8 2 by via -40 1020 100");
  float nearest = 1;
  for (int k = 0; k <= 1000; ++k)
    nearest =
        std::min(nearest, glm::distance(vec3(at(after, "by", float(k) / 1000)), vec3(-0.04f, 1.02f, 0.1f)));
  CHECK(nearest < 0.001f);
}

// Where one hangs on another's side its middle line is within that one.
TEST_CASE("a graft to or from a place that lies in another vessel is refused") {
  const Network tree = smallTree();
  CHECK(refusalOf(tree, "graft far 0.5 side 0 1").find("no way was found around \"trunk\"") !=
        std::string::npos);
  CHECK(refusalOf(tree, "graft side 0 far 0.5 1").find("no way was found around \"trunk\"") !=
        std::string::npos);
  CHECK(refusalOf(tree, "graft trunk 1 side 0 1").find("no way was found around \"trunk\"") !=
        std::string::npos);
}

TEST_CASE("a graft that is led far out of all vessels is refused before it is looked for") {
  const std::string refusal = refusalOf(smallTree(), "graft trunk 0.2 far 0.8 2 by via 4040 0 6");
  CHECK(refusal.find("its way is ") != std::string::npos);
  CHECK(refusal.find("millimetres") != std::string::npos);
  std::string forthAndBack = "graft trunk 0.2 far 0.8 2 by via";
  for (int k = 0; k < 100; ++k) forthAndBack += k % 2 == 0 ? " -40 1020 100" : " -40 1020 200";
  CHECK(refusalOf(smallTree(), forthAndBack).find("its way is ") != std::string::npos);
}
