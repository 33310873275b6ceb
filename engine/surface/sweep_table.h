#pragma once
#include <array>
#include <vector>

#include "network/network.h"
#include "surface/fork_plan.h"
#include "surface/patch.h"

namespace vasa {

/// One end of a tube that gets a cap.
struct CapEnd {
  std::uint32_t sweep = 0;
  bool last = false;  ///< at the sweep's last ring, else at its first
};

/// A network's surface as flat records, for the CPU and the shaders alike; constant over time. A sweep is a
/// span of a vessel; a span that forks cut is several sweeps, or none.
struct SweepTable {
  std::vector<shared::SweepRecord> sweeps;   ///< vessel after vessel, span after span
  std::vector<std::uint32_t> vesselOfSweep;  ///< one a sweep
  std::vector<std::uint32_t>
      spanOfSweep;           ///< one a sweep: its span, counted through all vessels of the network
  std::vector<CapEnd> caps;  ///< every end that no fork carries on
  std::vector<shared::ForkRecord> forks;                ///< those with fewer branches first
  std::vector<shared::ForkBranch> branches;             ///< fork after fork
  std::vector<std::uint32_t> vesselOfFork, spanOfFork;  ///< those whose colour a fork takes
  ForkWays ways;                                        ///< ForkPlan::ways
  PatchTable patches;                                   ///< in the place of forks (surface/patch.h)
  std::uint32_t pointCount = 0;                         ///< de Boor points of the network
  /// Knot quaternions: spans + 1 of each vessel, vessel after vessel.
  std::uint32_t knotCount = 0;
  std::uint32_t spanCount = 0;  ///< of all vessels
};
/// Cut as planForks() says (surface/fork_plan.h); patches of the network stand for their forks.
SweepTable makeSweepTable(const Network& network);
SweepTable makeSweepTable(const Network& network, ForkPlan plan);

/// Every span of every vessel, whole, whatever forks take of it: what places on a network are counted by.
std::vector<shared::SweepRecord> wholeSpans(const Network& network);

/// Index of a vessel's first knot quaternion (it has one for each span and one more).
std::uint32_t firstKnot(const Network& network, VesselId vessel);

/// The matrices of the span classes, b = M · d (curve/bspline.h); SweepRecord::spanClass points here.
const std::array<mat4, shared::kSpanClasses>& spanClassMatrices();

/// Knot quaternions of a whole network (curve/frame.h), in parallel over vessels.
/// @param points      de Boor points as Network::points()
/// @param references  one direction a vessel, from the bone or the parent that carries its first section
/// @param frames      caller-owned, SweepTable::knotCount of them
void networkFrames(const Network& network, std::span<const vec4> points, std::span<const vec3> references,
                   std::span<quat> frames);

/// Some reference direction a vessel for the rest shape, at right angles to its first tangent.
std::vector<vec3> restReferences(const Network& network);

}  // namespace vasa
