#pragma once
#include "convert/axes.h"

namespace vasa {

struct PruneReport {
  std::uint32_t pruned = 0;  ///< leaf chains removed
  std::uint32_t merged = 0;  ///< forks made one
  std::uint32_t loops = 0;   ///< small loops closed
};

/// Takes off what the surface's bumps and holes put into a Reeb graph: leaf chains shorter than the radius of
/// what they hang on, loops no longer than the way around it, forks nearer to each other than it,
/// and chains that run inside or close beside another one from the same fork (the strips of a torn tube).
/// @param detail     [m] what is shorter than this goes as well, however thin its parent
/// @param keepStubs  leaf chains stay whose tip lies far from the fork, however short they are
PruneReport prune(AxisGraph& graph, float detail, bool keepStubs = false);

}  // namespace vasa
