#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "growth/growth_rules.h"
#include "surface/tessellate.h"

namespace vasa {

// Capillaries are stored nowhere. The tissue is shared out among beds (scene/growth.h); in each a tree of the
// nearest artery and one of the nearest vein branch alike. A capillary is addressed by its bed, its side and
// its number in the tree, and everything about it follows from (seed, address) and the shape of the vessels.
// A tree's branches share its bed's box out among them, each curve runs to the middle of its own part, and
// the last curves of both trees meet there: so the tissue is filled evenly, and every artery's end has a
// vein's. This is the specification of shaders/lib/growth.glsl.

enum class BedSide : std::uint8_t { artery, vein };
constexpr std::array<BedSide, 2> kBedSides{BedSide::artery, BedSide::vein};

/// What growing reads.
struct GrowthScene {
  const PosedNetwork& network;
  const shared::GrowthTables& tables;
  std::span<const shared::SweepRecord> spans;  ///< wholeSpans() (surface/sweep_table.h)
  std::span<const shared::GrowthBed> beds;
  std::uint32_t seed = 1;
};

/// One capillary: a cubic space curve of varying thickness.
struct Capillary {
  Bezier curve;                  ///< (x, y, z, r) [m]; radii change evenly
  std::uint32_t generation = 0;  ///< 0: comes into the bed
  std::uint32_t symbol = 0;      ///< into GrowthTables::symbol
  float phase = 0;               ///< 0 at the vessel, towards 1 where artery and vein meet: the colour's way
  float lastPhase = 0;           ///< at its end
  bool leaf = false;             ///< nothing grows from it in a tree of so many generations
  vec4 skin{0};                  ///< dot(xyz, p) + w: how deep [m] a place p lies below the skin, about
};

/// The capillary with a number in one tree of a bed. Trees are counted stem first, then branch after branch.
/// @param levels  generations of the tree, 1 to shared::kMostGrowthLevels
/// @param number  below GrowthRules::treeSize
/// @param sparse  of the last generation every second curve is there, as thick as those that it stands for:
///                far thinner than a pixel, they cover as much of the picture
/// O(levels · branches), no allocation.
Capillary capillaryAt(const GrowthScene& scene, std::uint32_t bed, BedSide side, std::uint32_t levels,
                      std::uint32_t number, bool sparse = false);

/// Where a bed lies in the network's shape.
vec3 bedCentre(const PosedNetwork& network, std::span<const shared::SweepRecord> spans,
               const shared::GrowthBed& bed);

}  // namespace vasa
