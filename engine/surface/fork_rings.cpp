#include "surface/fork_rings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/fork_record.h"

namespace vasa {
namespace {

constexpr float kSameEnd = 1e-4f;   // [spans]
constexpr float kShortest = 1e-3f;  // [spans] of a tube

shared::ForkRing& ringAt(ForkPlan& plan, std::size_t fork, std::size_t ring) {
  shared::ForkRecord& record = plan.forks[fork];
  if (ring < 2) return ring == 0 ? record.a : record.b;
  return plan.branches[record.firstBranch + ring - 2].ring;
}

bool shorten(TubeStretch& tube, float outward, float to) {
  (outward > 0 ? tube.from : tube.to) = to;
  return tube.to - tube.from >= kShortest;
}

}  // namespace

ForkRings ringsOf(const ForkPlan& plan, const shared::ForkRecord& fork) {
  ForkRings rings{{&fork.a, &fork.b}, {fork.vesselA, fork.vesselB}, 2 + std::size_t(fork.branchCount)};
  for (std::uint32_t i = 0; i < fork.branchCount; ++i) {
    rings.ring[2 + i] = &plan.branches[fork.firstBranch + i].ring;
    rings.vessel[2 + i] = plan.branches[fork.firstBranch + i].vessel;
  }
  return rings;
}

float forkRingParameter(const Network& network, const shared::ForkRing& ring, std::uint32_t vessel) {
  return float(ring.point - network.vessels()[vessel].firstPoint) + ring.t;
}

std::optional<TubeBehind> tubeBehind(const ForkPlan& plan, std::uint32_t vessel, float parameter,
                                     float outward) {
  const auto first = std::ranges::lower_bound(plan.tubes, vessel, {}, &TubeStretch::vessel);
  for (auto tube = first; tube != plan.tubes.end() && tube->vessel == vessel; ++tube) {
    const float near = outward > 0 ? tube->from : tube->to;
    if (std::abs(near - parameter) < kSameEnd)
      return TubeBehind{std::size_t(tube - plan.tubes.begin()), near, outward > 0 ? tube->to : tube->from,
                        outward > 0 ? tube->capTo : tube->capFrom};
  }
  return std::nullopt;
}

bool moveRings(const Network& network, ForkPlan& plan, std::size_t fork, std::span<const float> parameters) {
  const ForkRings rings = ringsOf(plan, plan.forks[fork]);
  assert(parameters.size() == rings.count);
  std::array<std::pair<std::size_t, TubeStretch>, ForkPatch::kMostRings> before;
  std::size_t shortened = 0;
  bool fits = true;
  for (std::size_t i = 0; i < rings.count && fits; ++i) {
    const float own = forkRingParameter(network, *rings.ring[i], rings.vessel[i]);
    if (parameters[i] == own) continue;
    const auto behind = tubeBehind(plan, rings.vessel[i], own, rings.outward(i));
    fits = behind && rings.outward(i) * (parameters[i] - own) > 0;
    if (!fits) break;
    before[shortened++] = {behind->tube, plan.tubes[behind->tube]};
    fits = shorten(plan.tubes[behind->tube], rings.outward(i), parameters[i]);
  }
  if (!fits) {
    while (shortened-- > 0) plan.tubes[before[shortened].first] = before[shortened].second;
    return false;
  }
  for (std::size_t i = 0; i < rings.count; ++i) {
    shared::ForkRing& ring = ringAt(plan, fork, i);
    if (parameters[i] != forkRingParameter(network, ring, rings.vessel[i]))
      ring = forkRingAt(network, {rings.vessel[i], parameters[i], ring.turn < 0});
  }
  return true;
}

}  // namespace vasa
