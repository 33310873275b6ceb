#pragma once
#include <span>

#include "convert/strand.h"

namespace vasa {

struct SliverOptions {
  float areaShare = 0.01f;    ///< of the element's wall: a strand that tells less may be a sliver
  float radiusShare = 0.45f;  ///< of the element's mean radius: ... if it is that thin
  float lengthRadii = 3.0f;   ///< ... or so short beside the element's mean radius
  float pruned = 0.06f;       ///< share of the wall that may go in all
};

/// Torn and decimated surfaces break into threads: drops an element's strands that tell next to nothing of
/// its surface, the least first, as long as what is left hangs together as before.
/// @param strands  the element's
/// @return how many were dropped
std::uint32_t pruneSlivers(StrandGraph& graph, std::span<const std::uint32_t> strands,
                           const SliverOptions& options = {});

}  // namespace vasa
