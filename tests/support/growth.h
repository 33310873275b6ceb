#pragma once
#include "growth/capillary.h"
#include "growth/plan.h"

namespace vasa::test {

/// Every span of a network with a bed beside it, of two systems by turns: what growing and drawing need.
/// Stems leave vessels or, in every fourth bed, go on from the one before; some beds lack a side, some have
/// walls.
struct GrownNetwork {
  explicit GrownNetwork(Network chosen);
  GrownNetwork(const GrownNetwork&) = delete;

  PosedNetwork posed() const { return {table, points, frames}; }
  GrowthScene scene(const PosedNetwork& shape, std::uint32_t seed = 1) const {
    return {shape, rules.tables, beds.spans, beds.beds, seed};
  }
  /// Frames for points that were moved.
  void pose();

  Network network;
  SweepTable table;
  std::vector<vec4> points;
  std::vector<quat> frames;
  GrowthRules rules;
  CapillaryBeds beds;
};

/// Text with two systems: `oak` uses every kind of module and pull, `reed` only few.
const std::string& growthText();

}  // namespace vasa::test
