#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "growth/growth_rules.h"
#include "surface/tessellate.h"

namespace vasa {

// Capillaries are stored nowhere. One is addressed by its root (vessel, place on it, number there) and its
// number in the root's tree, and everything about it follows from (seed, address) and the shape of the vessel
// that it hangs on: not from what of the vessel is drawn. The last curves of a tree run into a tree of the
// site's partner, an artery's into a vein's and the other way round, each into the end of a curve before the
// last: so the bed is closed. This is the specification of shaders/lib/growth.glsl.

/// Where a tree of capillaries leaves a vessel.
struct Sprout {
  std::uint32_t span = 0;    ///< counted through all vessels of the network
  std::uint32_t number = 0;  ///< among the span's sprouts; with shared::kTipSprout, among those of a free end
};

/// What growing reads.
struct GrowthScene {
  const PosedNetwork& network;
  const shared::GrowthTables& tables;
  std::span<const shared::SweepRecord> spans;  ///< wholeSpans() (surface/sweep_table.h)
  std::span<const shared::GrowthSite> sites;   ///< one a span
  std::uint32_t seed = 1;
  std::uint32_t joinLevels = 0;  ///< trees of so many generations run into their partners', others end freely
};

/// One capillary: a cubic space curve of varying thickness.
struct Capillary {
  Bezier curve;                  ///< (x, y, z, r) [m]; radii change evenly
  std::uint32_t generation = 0;  ///< 0: leaves the vessel
  std::uint32_t symbol = 0;      ///< into GrowthTables::symbol
  float phase = 0;               ///< 0 at the vessel, towards 1 in the capillary bed: the colour's way
  std::uint32_t key = 0;
  /// Nothing grows from it in a tree of so many generations: it ends in a point, or.
  bool leaf = false;
  bool joined = false;  ///< in a curve of the partner's tree,
  float farPhase = 0;   ///< which has this phase there

  /// The phase at t of a curve that is not joined.
  float phaseAt(float t) const { return phase + (1 - phase) * 0.5f * t; }
};

/// The capillary with a number in the tree of a sprout. Trees are counted stem first, then branch after
/// branch.
/// @param levels  generations of the tree, 1 to shared::kMostGrowthLevels
/// @param number  below tables.symbol[axiom].treeSize[levels]
/// O(levels · branches), no allocation.
Capillary capillaryAt(const GrowthScene& scene, Sprout sprout, std::uint32_t levels, std::uint32_t number);

/// The section of the vessel that a sprout stands on. Its tree begins inside of the vessel, half way from the
/// axis to the wall, or on the axis at a free end.
Section rootSection(const GrowthScene& scene, Sprout sprout);

}  // namespace vasa
