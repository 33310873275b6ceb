#pragma once
#include "growth/plan.h"
#include "growth/regions.h"
#include "scene/tissue.h"

namespace vasa {

/// A place on a vessel that trees may hang on, or around which nothing grows.
struct BedSource {
  vec3 at{0};  ///< at rest
  float radius = 0;
  std::uint32_t span = 0;
  float t = 0;
  std::uint8_t region = 255;  ///< 255: nothing grows around it, but in organs
  bool againstFlow = false;   ///< blood flows against the span
};

/// What sharing the tissue out looks at.
struct BedWish {
  const GrowthRules& rules;
  const std::vector<GrowthRegion>& regions;
  std::span<const std::uint8_t> regionOfRoom;  ///< one a room of the tissue from 1 on
  PosedNetwork rest;
  std::span<const shared::SweepRecord> spans;
  std::array<std::vector<BedSource>, 2> sources;  ///< of arteries, of veins
  float scale = 1;                                ///< of the tables' lengths
  float mostWay = 0;                              ///< [m] from a vessel to what it feeds, through the tissue
};

/// Shares the tissue among beds and joins them to the vessels, each bed by way of its neighbours to the
/// nearest artery and to the nearest vein through the tissue: so trunks gather on their way to the vessel,
/// and no way leads through bone. Sets beds and their regions, in an order that depends on nothing else.
///
/// The tissue of a region is halved across its longest extent until every piece is as large as the region
/// says, and again where it fills too little of the box around it (a layer that bends around a bone). Radii
/// follow from Murray's law by the volume of the tissue behind a stem.
void shareOut(const Tissue& tissue, const BedWish& wish, CapillaryBeds& beds);

}  // namespace vasa
