#pragma once
#include <vector>

#include "growth/growth_rules.h"
#include "surface/tessellate.h"

namespace vasa {

/// Where in a network's shape capillaries grow; constant over time, and the same however forks cut its tubes.
struct CapillaryBeds {
  std::vector<shared::SweepRecord> spans;  ///< wholeSpans() (surface/sweep_table.h)
  std::vector<shared::GrowthBed> beds;
  std::vector<std::uint8_t> regionOfBed;
  std::vector<std::uint8_t> regionOfSpan;  ///< whose rules its vessel stands under, or 255
};

/// What a network's capillaries grow from; constant over time.
struct Growth {
  GrowthRules rules;
  CapillaryBeds beds;
};

/// What of the capillaries is asked for.
struct CapillaryWish {
  std::uint32_t levels = 0;  ///< generations of the trees; 0: none at all
  std::uint32_t edges = 0;   ///< of every curve's polyline: 3, 5, 8 or 10; 0: by its size in the picture
  /// Most curves in a picture: beyond it trees lose generations, the deepest first, and stems go last.
  std::uint32_t budget = 4'000'000;
  /// [pixels] generations with shorter curves are left out, and trees much thinner than a pixel are drawn as
  /// threads (ribbon.h) where `edges` is 0, those whose last curves are up to eight times as long with every
  /// second of these. 0: none is left out, all are ribbons.
  float smallest = 0.5f;
};

/// Curves that are grown into the ring of vertices and drawn together.
struct CapillaryBatch {
  std::uint32_t firstJob = 0, jobCount = 0;
  std::uint32_t curves = 0, edges = 0;  ///< edges: of ribbons, or shared::kThreads
};

/// What one picture draws of the capillaries, the farthest first.
struct CapillaryPlan {
  std::vector<shared::GrowthJob> jobs;
  std::vector<CapillaryBatch> batches;
  std::uint64_t curves = 0;  ///< that are drawn
  std::uint64_t trees = 0;
  std::uint64_t wishedCurves = 0;  ///< of all trees in the picture, before the budget
};

/// What planning looks at.
struct PlanInput {
  PosedNetwork network;
  const shared::GrowthTables& tables;
  const CapillaryBeds& beds;
  const shared::GrowthView& view;
};

/// Curves of all trees, wherever they are.
std::uint64_t curveCount(const shared::GrowthTables& tables, const CapillaryBeds& beds, std::uint32_t levels);

/// Most jobs that a plan has on a network: what its buffer must hold.
std::uint32_t mostJobs(const CapillaryBeds& beds);

/// Chooses what is drawn: trees that may be seen, as many generations as have some size in the picture,
/// within the budget. The work and the memory grow with the beds, not with the curves. The result depends on
/// the input alone.
void planCapillaries(const PlanInput& input, const CapillaryWish& wish, CapillaryPlan& plan);

/// Levels that a system's trees may have: wished levels, or fewer where a tree would not fit the ring.
std::uint32_t levelsOf(const shared::GrowthTables& tables, std::uint32_t system, std::uint32_t wished);

}  // namespace vasa
