#include "surface/fork_rings.h"

#include <doctest/doctest.h>

#include "support/frames.h"
#include "support/manifold.h"
#include "support/networks.h"
#include "surface/surface_mesh.h"

using namespace vasa;

namespace {

std::size_t openEdgesOf(const Network& network, ForkPlan plan) {
  const std::vector<quat> frames = test::framesOf(network);
  const SweepTable table = makeSweepTable(network, std::move(plan));
  return test::openEdges(surfaceMesh(PosedNetwork{table, network.points(), frames}, {7, 3}).triangles);
}

// Where a fork's rings are, each moved over a share of the tube behind it, where there is one.
std::vector<float> movedBy(const Network& network, const ForkPlan& plan, std::size_t fork, float share) {
  const ForkRings rings = ringsOf(plan, plan.forks[fork]);
  std::vector<float> parameters;
  for (std::size_t i = 0; i < rings.count; ++i) {
    const float own = forkRingParameter(network, *rings.ring[i], rings.vessel[i]);
    const auto behind = tubeBehind(plan, rings.vessel[i], own, rings.outward(i));
    parameters.push_back(behind ? glm::mix(own, behind->far, share) : own);
  }
  return parameters;
}

}  // namespace

TEST_CASE("rings move out into the tubes behind them, and the surface stays closed") {
  const Network network = test::branchingNetwork(41, 5);
  ForkPlan plan = planForks(network);
  REQUIRE(plan.forks.size() > 10);
  std::size_t moved = 0;
  for (std::size_t fork = 0; fork < plan.forks.size(); ++fork) {
    const std::vector<float> wanted = movedBy(network, plan, fork, 0.3f);
    REQUIRE(moveRings(network, plan, fork, wanted));
    const ForkRings rings = ringsOf(plan, plan.forks[fork]);
    for (std::size_t i = 0; i < rings.count; ++i) {
      CHECK(forkRingParameter(network, *rings.ring[i], rings.vessel[i]) == doctest::Approx(wanted[i]));
      const auto behind = tubeBehind(plan, rings.vessel[i], wanted[i], rings.outward(i));
      moved += behind && behind->near == wanted[i];
    }
  }
  CHECK(moved > plan.forks.size());
  CHECK(openEdgesOf(network, plan) == 0);
}

TEST_CASE("a tube that is too short leaves the plan as it was") {
  const Network network = test::branchingNetwork(41, 5);
  ForkPlan plan = planForks(network);
  const ForkPlan before = plan;
  for (const float share : {1.0f, 1.5f, -0.1f}) {
    for (std::size_t fork = 0; fork < plan.forks.size(); ++fork) {
      const std::vector<float> wanted = movedBy(network, plan, fork, share);
      if (wanted == movedBy(network, plan, fork, 0)) continue;
      CHECK(!moveRings(network, plan, fork, wanted));
    }
  }
  for (std::size_t i = 0; i < plan.tubes.size(); ++i) {
    CHECK(plan.tubes[i].from == before.tubes[i].from);
    CHECK(plan.tubes[i].to == before.tubes[i].to);
  }
}
