#pragma once
#include "convert/axes.h"

namespace vasa {

struct PruneReport {
  std::uint32_t pruned = 0;  ///< leaf chains removed
  std::uint32_t merged = 0;  ///< forks made one
  std::uint32_t loops = 0;   ///< small loops closed
};

/// Takes off what the surface's bumps and holes put into a Reeb graph: leaf chains shorter than the radius of
/// what they hang on, loops no longer than the way around it, and forks nearer to each other than it.
/// The longest way through the graph always stays.
PruneReport prune(AxisGraph& graph);

}  // namespace vasa
