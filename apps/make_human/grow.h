#pragma once
#include <memory>

#include "make_human/regions.h"

namespace vasa::human {

struct GrowOptions {
  std::uint32_t sweeps = 7150;  ///< of the whole network, at least
  std::uint64_t seed = 1;
};

/// Adds small vessels to those laid out until the network has the wanted number of sweeps: branches that fill
/// the regions, an artery and, where the region has companions, a vein beside it.
///
///   Grower grower(vessels, regions, around, options);
///   grower.run();  grower.remove(number);  grower.run();
///   network = joinVessels(grower.finish(), bodyHeight);
///
/// Method: of several quasi-random places in a region (Roberts 2018) the one farthest from all its leaders
/// (best candidate, Mitchell 1991) gets a branch from the nearest of them, curved, pushed off bones, skin and
/// other vessels, and refused where it still comes too near to one: constrained constructive optimisation
/// (Schreiner, Buxbaum 1993) with the shortest branch as the optimum. Radii by Murray 1926: the cubes of a
/// fork's branches add up to that of its stem. Wide spacing comes first, so a network of more sweeps contains
/// finer vessels between those of a coarser one. Deterministic.
class Grower {
 public:
  /// @param vessels  those of the table; grown ones are appended. All references must outlive this
  Grower(std::vector<LaidVessel>& vessels, const std::vector<Region>& regions, const Surroundings& around,
         const GrowOptions& options);
  ~Grower();

  /// Grows until there are enough sweeps, thinner branches where the regions are full, or until these have no
  /// room either.
  void run();
  /// Takes a grown vessel away, and what grew on it; its place stays empty. False for a vessel of the table
  /// or one that is gone already.
  bool remove(int vessel);
  /// The vessels of the table and those that are left of the grown, numbered anew.
  std::vector<LaidVessel> finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa::human
