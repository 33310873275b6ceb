#include "repair/rest_repair.h"

#include <doctest/doctest.h>

#include "avoid/interference.h"
#include "support/networks.h"
#include "support/walk.h"

using namespace vasa;

namespace {

// A wide vessel, and a thin one across it that lies in its side.
Network grazing(float height) {
  NetworkBuilder builder;
  builder.addVessel({"wide", "", VesselKind::vein}, test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.006f, 20));
  builder.addVessel({"thin", "", VesselKind::artery},
                    test::line({0, height, -0.1f}, {0.005f, height, 0.1f}, 0.001f, 20));
  return test::built(builder);
}

}  // namespace

TEST_CASE("vessels that overlap at rest are parted, the thin one more than the wide one") {
  const Network network = grazing(0.0062f);
  const RestRepair repair = separateAtRest(network);
  CHECK(repair.pairsBefore > 0);
  CHECK(repair.pairsAfter == 0);
  CHECK(repair.left.empty());
  CHECK(Interference(repair.network).restPairCount() == 0);
  CHECK(repair.movedMax > 0.0003f);
  CHECK(repair.movedMax < 0.0012f);
  float wide = 0, thin = 0;
  for (std::size_t p = 0; p < network.points().size(); ++p) {
    float& most = p < network.vessels()[1].firstPoint ? wide : thin;
    most = std::max(most, glm::distance(vec3(network.points()[p]), vec3(repair.network.points()[p])));
  }
  CHECK(wide < 0.2f * thin);
}

TEST_CASE("vessels that run side by side are moved apart along all their length, not thinned") {
  for (const std::uint32_t spans : {1u, 4u}) {
    NetworkBuilder builder;
    builder.addVessel({"artery", "", VesselKind::artery},
                      test::straightVessel({0, 0, 0}, {0, 0.06f, 0}, 0.003f, spans));
    builder.addVessel({"vein", "", VesselKind::vein},
                      test::straightVessel({0.0055f, 0, 0}, {0.0055f, 0.06f, 0}, 0.004f, spans));
    const RestRepair repair = separateAtRest(test::built(builder));
    CHECK(repair.pairsAfter == 0);
    CHECK(repair.thinnedMax < 0.01f);
    CHECK(repair.movedMax < 0.0016f);
  }
}

TEST_CASE("a network without overlaps stays as it is, to the byte") {
  const Network network = grazing(0.008f);
  const RestRepair repair = separateAtRest(network);
  CHECK(repair.pairsBefore == 0);
  CHECK(repair.movedMax == 0);
  CHECK(repair.thinnedMax == 0);
  CHECK(std::ranges::equal(repair.network.points(), network.points()));
}

TEST_CASE("a vessel that is told twice is left and said to be") {
  NetworkBuilder builder;
  builder.addVessel({"once", "", VesselKind::artery}, test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.002f, 20));
  builder.addVessel({"again", "", VesselKind::artery},
                    test::line({-0.1f, 0.0001f, 0}, {0.1f, 0.0001f, 0}, 0.002f, 20));
  const Network network = test::built(builder);
  const RestRepair repair = separateAtRest(network);
  REQUIRE(repair.left.size() == 1);
  CHECK(repair.left[0].reason == OverlapReason::twice);
  CHECK(repair.pairsAfter == repair.left[0].pairs);
  CHECK(reasonName(repair.left[0].reason) == "twice");
}

TEST_CASE("to tell what overlaps changes nothing") {
  const Network network = grazing(0.0062f);
  const RestRepair told = overlapsAtRest(network);
  CHECK(told.pairsBefore == separateAtRest(network).pairsBefore);
  CHECK(told.pairsAfter == told.pairsBefore);
  REQUIRE(told.left.size() == 1);
  CHECK(std::abs(told.left[0].depth - 0.0008f) < 1e-4f);
  CHECK(std::ranges::equal(told.network.points(), network.points()));
}
