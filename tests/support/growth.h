#pragma once
#include "growth/capillary.h"
#include "growth/plan.h"

namespace vasa::test {

/// Every vessel of a network with capillaries of two systems on it, by turns: what growing and drawing them
/// need.
struct GrownNetwork {
  explicit GrownNetwork(Network chosen);
  GrownNetwork(const GrownNetwork&) = delete;

  PosedNetwork posed() const { return {table, points, frames}; }
  GrowthScene scene(const PosedNetwork& shape, std::uint32_t seed = 1) const {
    return {shape, rules.tables, sites.spans, sites.sites, seed, joinLevels};
  }
  /// Frames for points that were moved.
  void pose();

  Network network;
  SweepTable table;
  std::vector<vec4> points;
  std::vector<quat> frames;
  GrowthRules rules;
  CapillarySites sites;
  std::uint32_t joinLevels = 0;
};

/// Text with two systems: `oak` uses every kind of module and pull, `reed` only few.
const std::string& growthText();

}  // namespace vasa::test
