#pragma once
#include <vector>

#include "body/phases.h"
#include "network/network.h"

namespace vasa {

/// What of a network must not be torn: points that follow one another along a vessel, ends that share a node,
/// an end and the span of its host, and points of two vessels that run side by side, no further apart than
/// about twice their radii. In one order. O(points log points).
std::vector<Tie> tiesOf(const Network& network);

}  // namespace vasa
