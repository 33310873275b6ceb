#include "surface/sweep_table.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "curve/frame.h"

namespace vasa {
namespace {

// Knots i-2 .. i+3, clamped to [0, spans], settle a span's matrix; so two spans to either side matter.
std::uint32_t spanClass(std::uint32_t span, std::uint32_t spans) {
  return 3 * std::min(span, 2u) + std::min(spans - 1 - span, 2u);
}

bool needsCap(const Network& network, NodeId node) {
  return !node.valid() || !network.node(node).host;
}

void addVessel(const Network& network, std::uint32_t index, SweepTable& table) {
  const Vessel& vessel = network.vessels()[index];
  const std::uint32_t spans = vessel.spanCount(), first = std::uint32_t(table.sweeps.size());
  for (std::uint32_t span = 0; span < spans; ++span) {
    const std::uint32_t next = span + 1 < spans ? spanClass(span + 1, spans) : shared::kNoSpan;
    table.sweeps.push_back({vessel.firstPoint + span, table.knotCount + span, spanClass(span, spans), next,
                            vessel.firstPoint, vessel.firstPoint + vessel.pointCount - 1, index, 0});
    table.vesselOfSweep.push_back(index);
  }
  const auto cap = [&](std::uint32_t sweep, bool last) {
    table.caps.push_back({sweep, last});
    table.sweeps[sweep].caps |= last ? 2 : 1;
  };
  if (needsCap(network, vessel.start)) cap(first, false);
  if (needsCap(network, vessel.end)) cap(first + spans - 1, true);
  table.knotCount += spans + 1;
}

}  // namespace

SweepTable makeSweepTable(const Network& network) {
  SweepTable table;
  table.sweeps.reserve(network.sweepCount());
  table.vesselOfSweep.reserve(network.sweepCount());
  table.pointCount = std::uint32_t(network.points().size());
  for (std::uint32_t i = 0; i < network.vessels().size(); ++i) addVessel(network, i, table);
  return table;
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
    knotFrames(Network::pointsOf(vessel, points), references[i], frames.subspan(first, vessel.spanCount() + 1));
  });
}

std::vector<vec3> restReferences(const Network& network) {
  std::vector<vec3> references;
  for (const Vessel& vessel : network.vessels())
    references.push_back(anyPerpendicular(unitTangent(network.pointsOf(vessel), 0)));
  return references;
}

}  // namespace vasa
