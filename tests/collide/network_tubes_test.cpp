#include "collide/network_tubes.h"

#include <doctest/doctest.h>

#include "collide/closest_tubes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

std::vector<Bezier> shapeOf(const NetworkTubes& tubes, const Network& network) {
  std::vector<Bezier> shape(tubes.count());
  tubes.shape(network.points(), shape);
  return shape;
}

// A straight vessel along x, and a branch that leaves its side at u = 3.25 along +z.
Network tee() {
  NetworkBuilder builder;
  std::vector<vec4> host, branch;
  for (int k = 0; k < 13; ++k) host.emplace_back(0.1f * float(k), 0, 0, 0.02f);
  const VesselId hostId = builder.addVessel({"host", "", VesselKind::artery}, host);
  const vec4 root = evaluate(host, 3.25f);
  for (int k = 0; k < 7; ++k) branch.emplace_back(root.x, 0, 0.1f * float(k), 0.02f);
  const VesselId branchId = builder.addVessel({"branch", "", VesselKind::artery}, branch);
  builder.joinToSide({branchId, false}, {hostId, 3.25f});
  return test::built(builder);
}

}  // namespace

TEST_CASE("tubes are the spans, vessel after vessel, in any shape") {
  const Network network = test::windingNetwork(20, 3);
  const NetworkTubes tubes(network);
  CHECK(tubes.count() == network.sweepCount());
  const auto shape = shapeOf(tubes, network);
  for (std::uint32_t i = 0; i < tubes.count(); ++i) {
    const auto [vessel, span] = tubes.address(i);
    CHECK(tubes.tube(vessel, span) == i);
    const Bezier expected = bezierOfSpan(network.pointsOf(network.vessel(vessel)), span);
    for (std::size_t k = 0; k < 4; ++k) CHECK(glm::length(shape[i].b[k] - expected.b[k]) < 1e-6f);
  }
}

TEST_CASE("neighbours: along a vessel and from a side branch into its host") {
  const NetworkTubes tubes(tee(), 2);
  const auto& exclusions = tubes.neighbours();
  CHECK(exclusions.contains(4, 5));
  CHECK(!exclusions.contains(4, 6));
  const std::uint32_t branch = tubes.tube({1}, 0);
  CHECK(exclusions.contains(3, branch));
  CHECK(exclusions.contains(2, branch));
  CHECK(!exclusions.contains(5, branch));
  CHECK(!exclusions.contains(0, 9));
}
