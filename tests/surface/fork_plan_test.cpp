#include "surface/fork_plan.h"

#include <doctest/doctest.h>

#include "core/hash.h"
#include "network/reshape.h"
#include "support/frames.h"
#include "support/manifold.h"
#include "support/networks.h"
#include "surface/fork_check.h"
#include "surface/fork_memory.h"
#include "surface/surface_mesh.h"

using namespace vasa;

namespace {

vec3 direction(float degrees, float turn = 0) {
  const float a = glm::radians(degrees), t = glm::radians(turn);
  return {std::sin(a) * std::cos(t), std::sin(a) * std::sin(t), std::cos(a)};
}

// A trunk along z, radius 1 cm, and branches from its middle.
Network trunkWith(const std::vector<std::pair<vec3, float>>& branches) {
  NetworkBuilder builder;
  const VesselId trunk =
      builder.addVessel({"trunk"}, test::straightVessel({0, 0, -0.2f}, {0, 0, 0.2f}, 0.01f, 4));
  for (const auto& [along, radius] : branches)
    builder.joinToSide(
        {builder.addVessel({"branch"}, test::straightVessel({0, 0, 0}, 0.2f * along, radius, 4)), false},
        {trunk, 2});
  return test::built(builder);
}

// Ends of several vessels that meet in the origin.
Network star(const std::vector<std::pair<vec3, float>>& arms) {
  NetworkBuilder builder;
  std::vector<VesselEnd> ends;
  for (const auto& [along, radius] : arms)
    ends.push_back(
        {builder.addVessel({"arm"}, test::straightVessel({0, 0, 0}, 0.2f * along, radius, 4)), false});
  builder.joinEnds(ends);
  return test::built(builder);
}

struct Outcome {
  ForkPlan::Report report;
  std::uint32_t folds = 0;
};

// The surface is closed at all extremes of m and n.
Outcome checkedSurface(const Network& network) {
  Outcome outcome{planForks(network).report, 0};
  const std::vector<quat> frames = test::framesOf(network);
  const SweepTable table = makeSweepTable(network);
  const PosedNetwork posed{table, network.points(), frames};
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{4, 20}, SweepShape{7, 5}, SweepShape{8, 5},
                                 SweepShape{16, 2}, SweepShape{16, 20}}) {
    const SurfaceMesh mesh = surfaceMesh(posed, shape);
    CHECK(test::openEdges(mesh.triangles) == 0);
    CHECK(test::openEdges(test::weldedByBits(mesh.positions, mesh.triangles)) == 0);
  }
  for (const shared::ForkRecord& fork : table.forks) outcome.folds += foldedUnsmoothed(posed, fork, 8);
  return outcome;
}

}  // namespace

TEST_CASE("side branches of all sizes at all angles: a fork each, closed, unfolded") {
  for (const float ratio : {0.05f, 0.3f, 0.7f, 1.0f})
    for (const float angle : {90.0f, 60.0f, 35.0f, 20.0f, 120.0f}) {
      CAPTURE(ratio);
      CAPTURE(angle);
      const Outcome outcome = checkedSurface(trunkWith({{direction(angle), 0.01f * ratio}}));
      CHECK(outcome.report.forked == 1);
      CHECK(outcome.folds == 0);
    }
}

TEST_CASE("crossings: two branches at one place, one fork where they leave on different sides") {
  const Outcome across = checkedSurface(trunkWith({{direction(90), 0.006f}, {direction(90, 180), 0.006f}}));
  CHECK(across.report.forked == 2);
  CHECK(across.folds == 0);
  CHECK(makeSweepTable(trunkWith({{direction(90), 0.006f}, {direction(90, 180), 0.006f}})).forks.size() == 1);
  const Outcome beside = checkedSurface(trunkWith({{direction(70), 0.004f}, {direction(110), 0.004f}}));
  CHECK(beside.report.forked == 2);
  CHECK(beside.folds == 0);
}

TEST_CASE("vessels that end in one point: in two, three, four and five") {
  for (const float spread : {25.0f, 40.0f, 60.0f}) {
    CAPTURE(spread);
    const Outcome fork = checkedSurface(
        star({{direction(180), 0.01f}, {direction(spread), 0.008f}, {direction(-spread), 0.007f}}));
    CHECK(fork.report.forked == 1);
    CHECK(fork.report.joins == 1);
    CHECK(fork.folds == 0);
  }
  CHECK(checkedSurface(star({{direction(180), 0.01f}, {direction(20), 0.006f}})).report.joins == 1);
  CHECK(checkedSurface(star({{direction(180), 0.01f},
                             {direction(0), 0.01f},
                             {direction(90), 0.008f},
                             {direction(-90), 0.008f}}))
            .folds == 0);
  CHECK(checkedSurface(star({{direction(180), 0.01f},
                             {direction(0), 0.01f},
                             {direction(90), 0.004f},
                             {direction(90, 120), 0.004f},
                             {direction(90, 240), 0.004f}}))
            .folds == 0);
}

TEST_CASE("vessels that overlap where three meet: two run on into one another, the third is a branch") {
  NetworkBuilder builder;
  const VesselId right =
      builder.addVessel({"right"}, test::straightVessel(0.2f * direction(150), {0, 0, 0}, 0.006f, 4));
  const VesselId left =
      builder.addVessel({"left"}, test::straightVessel({0, 0, 0}, 0.2f * direction(210), 0.006f, 4));
  builder.joinEnds({{right, true}, {left, false}});
  builder.joinToSide(
      {builder.addVessel({"cava"}, test::straightVessel(0.008f * direction(210), {0, 0, 0.2f}, 0.007f, 4)),
       false},
      {left, 4 * 0.008f / 0.2f});
  const Outcome outcome = checkedSurface(test::built(builder));
  CHECK(outcome.report.joins == 1);
  CHECK(outcome.report.branches == 1);
  CHECK(outcome.report.forked == 1);
}

TEST_CASE("two vessels that meet at a right angle run on into one another") {
  const Outcome outcome = checkedSurface(star({{direction(180), 0.01f}, {direction(85), 0.01f}}));
  CHECK(outcome.report.joins == 1);
  CHECK(outcome.report.branches == 0);
  CHECK(outcome.folds == 0);
}

TEST_CASE("what starts on a branch that is still within the trunk leaves the trunk") {
  NetworkBuilder builder;
  const VesselId trunk =
      builder.addVessel({"trunk"}, test::straightVessel({0, 0, -0.2f}, {0, 0, 0.2f}, 0.01f, 4));
  const VesselId one = builder.addVessel({"one"}, test::straightVessel({0, 0, 0}, {0.2f, 0, 0}, 0.005f, 4));
  builder.joinToSide({one, false}, {trunk, 2});
  builder.joinToSide(
      {builder.addVessel({"other"}, test::straightVessel({0.007f, 0, 0}, {-0.2f, 0, 0.02f}, 0.005f, 4)),
       false},
      {one, 4 * 0.007f / 0.2f});
  const ForkPlan plan = planForks(test::built(builder));
  CHECK(plan.report.forked == 2);
  for (const shared::ForkRecord& fork : plan.forks) CHECK(fork.vesselA == trunk.value);
}

TEST_CASE("where two wide forks find no room one is made narrower") {
  NetworkBuilder builder;
  const float length = 0.052f;
  const VesselId trunk =
      builder.addVessel({"trunk"}, test::straightVessel({0, 0, 0}, {0, 0, length}, 0.01f, 4));
  for (const float share : {0.3f, 0.7f})
    builder.joinToSide(
        {builder.addVessel(
             {"branch"}, test::straightVessel({0, 0, share * length}, {0.2f, 0, share * length}, 0.006f, 4)),
         false},
        {trunk, 4 * share});
  const Outcome outcome = checkedSurface(test::built(builder));
  CHECK(outcome.report.forked == 2);
  CHECK(outcome.folds == 0);
}

TEST_CASE("what cannot be forked stays a closed tube of its own, and is counted") {
  NetworkBuilder builder;
  const VesselId trunk =
      builder.addVessel({"trunk"}, test::straightVessel({0, 0, -0.2f}, {0, 0, 0.2f}, 0.01f, 4));
  builder.joinToSide(
      {builder.addVessel({"inside"}, test::straightVessel({0, 0, 0}, {0.003f, 0, 0.1f}, 0.002f, 4)), false},
      {trunk, 2});
  const auto network = builder.build(1);
  REQUIRE(network.ok());
  const Outcome outcome = checkedSurface(*network);
  CHECK(outcome.report.branches == 1);
  CHECK(outcome.report.hidden == 1);
}

TEST_CASE("random trees: every branch is accounted for, no fork is a stump at rest") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const Network network = test::branchingNetwork(20, seed);
    const ForkPlan::Report report = planForks(network).report;
    CHECK(report.branches ==
          report.forked + report.hidden + report.tooShort + report.crowded + report.folded);
    const std::vector<quat> frames = test::framesOf(network);
    const SweepTable table = makeSweepTable(network);
    for (const shared::ForkRecord& fork : table.forks) {
      CHECK(!isStump({table, network.points(), frames}, fork, 8));
      CHECK(foldedTriangles({table, network.points(), frames}, fork, 8, nullptr) == 0);
    }
  }
}

namespace {

std::uint64_t hashOfPlan(const ForkPlan& plan) {
  std::uint64_t hash = hashOf(std::span(plan.forks));
  hash = hashOf(std::span(plan.branches), hash);
  hash = hashOf(std::span(plan.vesselOfFork), hash);
  for (const TubeStretch& tube : plan.tubes) {
    const float ends[]{tube.from, tube.to, float(tube.vessel), float(2 * tube.capFrom + tube.capTo)};
    hash = hashOf(std::span<const float>(ends), hash);
  }
  return hash;
}

// One vessel with other points: wider, and bent aside in its middle.
Network withOtherVessel(const Network& network, std::size_t which) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  const Vessel& vessel = network.vessels()[which];
  for (std::uint32_t i = 2; i + 2 < vessel.pointCount; ++i)
    points[vessel.firstPoint + i] += vec4(0, 0.3f, 0.2f, 0.2f) * points[vessel.firstPoint + i].w;
  pinEnds(network, points);
  auto edited = reshapeNetwork(network, points, network.bodyHeight());
  REQUIRE(edited.ok());
  return std::move(*edited);
}

}  // namespace

TEST_CASE("plans are the same with what earlier ones have found out") {
  ForkMemory memory;
  int others = 0;  // a vessel's end without forks may be anywhere
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const Network network = test::branchingNetwork(20, seed);
    CHECK(hashOfPlan(planForks(network, memory)) == hashOfPlan(planForks(network)));
    for (const std::size_t vessel : {std::size_t(0), std::size_t(1), network.vessels().size() - 1}) {
      const Network edited = withOtherVessel(network, vessel);
      CHECK(hashOfPlan(planForks(edited, memory)) == hashOfPlan(planForks(edited)));
      others += hashOfPlan(planForks(edited)) != hashOfPlan(planForks(network));
    }
  }
  CHECK(others > 20);
  const std::size_t exits = memory.exits.size(), folds = memory.folds.size();
  planForks(test::branchingNetwork(20, 1), memory);
  CHECK(memory.exits.size() == exits);
  CHECK(memory.folds.size() == folds);
}

TEST_CASE("a network planned as it was before has the same plan; an edited one as many forks") {
  ForkMemory memory;
  std::uint32_t forks = 0, others = 0;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const Network network = test::branchingNetwork(20, seed);
    const ForkPlan plan = planForks(network);
    CHECK(hashOfPlan(planForksAs(network, plan.ways, memory)) == hashOfPlan(plan));
    const Network edited = withOtherVessel(network, 0);
    const ForkPlan live = planForksAs(edited, plan.ways, memory);
    forks += plan.report.forked, others += live.report.forked;
    CHECK(live.report.forked <= plan.report.forked);
  }
  CHECK(forks > 100);
  CHECK(others > forks * 0.9);
}
