#include "surface/sweep_table.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/parallel.h"
#include "curve/frame.h"
#include "network/network_key.h"
#include "surface/fork_record.h"
#include "surface/kept_table.h"

namespace vasa {
namespace {

void addCap(SweepTable& table, std::uint32_t sweep, bool last) {
  table.caps.push_back({sweep, last});
  table.sweeps[sweep].caps |= last ? 2 : 1;
}

// The sweeps of one stretch of tube.
void addTube(const Network& network, const TubeStretch& tube, std::uint32_t spansBefore, SweepTable& table) {
  const Vessel& vessel = network.vessels()[tube.vessel];
  const std::uint32_t spans = vessel.spanCount(), first = std::uint32_t(table.sweeps.size());
  const std::uint32_t knot = firstKnot(network, {tube.vessel});
  for (std::uint32_t span = locate(tube.from, spans).span; span < spans && float(span) < tube.to; ++span) {
    const std::uint32_t next = span + 1 < spans ? spanClassOf(span + 1, spans) : shared::kNoSpan;
    table.sweeps.push_back({vessel.firstPoint + span, knot + span, spanClassOf(span, spans), next,
                            vessel.firstPoint, vessel.firstPoint + vessel.pointCount - 1, tube.vessel, 0,
                            std::max(tube.from - float(span), 0.0f), std::min(tube.to - float(span), 1.0f)});
    table.vesselOfSweep.push_back(tube.vessel);
    table.spanOfSweep.push_back(spansBefore + span);
  }
  if (tube.capFrom) addCap(table, first, false);
  if (tube.capTo) addCap(table, std::uint32_t(table.sweeps.size() - 1), true);
}

}  // namespace

SweepTable makeSweepTable(const Network& network) {
  const std::uint64_t key = networkKey(network);
  if (auto kept = findTable(key)) return std::move(*kept);
  ForkPlan plan = planForks(network);
  PatchTable patches = takePatches(network, plan);
  SweepTable table = makeSweepTable(network, std::move(plan));
  table.patches = std::move(patches);
  keepTable(key, table);
  return table;
}

SweepTable makeSweepTable(const Network& network, ForkPlan plan) {
  SweepTable table;
  table.sweeps.reserve(network.sweepCount());
  table.pointCount = std::uint32_t(network.points().size());
  table.knotCount = network.sectionCount();
  std::vector<std::uint32_t> firstSpan;
  for (const Vessel& vessel : network.vessels()) {
    firstSpan.push_back(table.spanCount);
    table.spanCount += vessel.spanCount();
  }
  for (const TubeStretch& tube : plan.tubes) addTube(network, tube, firstSpan[tube.vessel], table);
  table.branches = std::move(plan.branches);
  table.ways = std::move(plan.ways);
  // By branches, and by how often they are smoothed: devices run several forks in step, and those with less
  // to do would wait for the others.
  std::vector<std::size_t> order(plan.forks.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return std::pair(plan.forks[i].branchCount, plan.steps[i]); });
  for (const std::size_t i : order) {
    table.forks.push_back(plan.forks[i]);
    table.vesselOfFork.push_back(plan.vesselOfFork[i]);
  }
  for (std::size_t i = 0; i < table.forks.size(); ++i) {
    const std::uint32_t vessel = table.vesselOfFork[i];
    table.spanOfFork.push_back(firstSpan[vessel] + table.forks[i].a.point -
                               network.vessels()[vessel].firstPoint);
  }
  return table;
}

std::vector<shared::SweepRecord> wholeSpans(const Network& network) {
  SweepTable table;
  const auto vessels = network.vessels();
  for (std::uint32_t i = 0; i < vessels.size(); ++i)
    addTube(network, {i, 0, float(vessels[i].spanCount()), false, false}, std::uint32_t(table.sweeps.size()),
            table);
  return std::move(table.sweeps);
}

std::uint32_t firstKnot(const Network& network, VesselId vessel) {
  // spans + 3 points but spans + 1 knots a vessel
  return network.vessel(vessel).firstPoint - 2 * vessel.value;
}

const std::array<mat4, shared::kSpanClasses>& spanClassMatrices() {
  static const auto matrices = [] {
    std::array<mat4, shared::kSpanClasses> values;
    for (std::uint32_t before = 0; before < 3; ++before)
      for (std::uint32_t after = 0; after < 3; ++after)
        values[3 * before + after] = spanToBezier(before, before + 1 + after);
    return values;
  }();
  return matrices;
}

void networkFrames(const Network& network, std::span<const vec4> points, std::span<const vec3> references,
                   std::span<quat> frames) {
  assert(references.size() == network.vessels().size());
  parallelFor(network.vessels().size(), 16, [&](std::size_t i) {
    const Vessel& vessel = network.vessels()[i];
    const std::uint32_t first = firstKnot(network, {std::uint32_t(i)});
    knotFrames(Network::pointsOf(vessel, points), references[i],
               frames.subspan(first, vessel.spanCount() + 1));
  });
}

std::vector<vec3> restReferences(const Network& network) {
  std::vector<vec3> references;
  for (const Vessel& vessel : network.vessels())
    references.push_back(anyPerpendicular(unitTangent(network.pointsOf(vessel), 0)));
  return references;
}

}  // namespace vasa
