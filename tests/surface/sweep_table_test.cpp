#include "surface/sweep_table.h"

#include <doctest/doctest.h>

#include "curve/bspline.h"
#include "support/networks.h"
#include "surface/tessellate.h"

using namespace vasa;

TEST_CASE("span classes give each span's own matrix, bit for bit") {
  for (std::uint32_t spans = 1; spans < 12; ++spans) {
    const Network network = test::straightVessel(1, 0.1f, 0.1f, spans);
    const SweepTable table = makeSweepTable(network);
    REQUIRE(table.sweeps.size() == spans);
    for (std::uint32_t span = 0; span < spans; ++span)
      CHECK(spanClassMatrices()[table.sweeps[span].spanClass] == spanToBezier(span, spans));
    CHECK(table.sweeps.back().nextClass == shared::kNoSpan);
  }
}

TEST_CASE("records follow the vessels, and forks take what is theirs") {
  const Network network = test::windingNetwork(30, 5);
  const SweepTable table = makeSweepTable(network);
  CHECK(table.knotCount == network.sectionCount());
  CHECK(table.spanCount == network.sweepCount());
  CHECK(table.forks.size() == table.vesselOfFork.size());
  // An end of a tube is capped or carried on by a fork, whose trunk has two rings and whose branch has one.
  CHECK(table.caps.size() == 2 * 30 - table.forks.size());
  for (std::uint32_t i = 0; i < table.sweeps.size(); ++i) {
    const VesselId vessel{table.vesselOfSweep[i]};
    const std::uint32_t span = table.sweeps[i].point - network.vessel(vessel).firstPoint;
    CHECK(table.sweeps[i].knot == firstKnot(network, vessel) + span);
    CHECK(table.sweeps[i].from < table.sweeps[i].to);
    if (table.sweeps[i].from > 0) CHECK((table.sweeps[i].caps & 1) == 0);
  }
}
