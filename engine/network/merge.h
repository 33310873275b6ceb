#pragma once
#include "core/result.h"
#include "network/network.h"

namespace vasa {

/// One network of several (arteries and veins from two files): vessels and nodes one after the other. The
/// body height is the first one's. Fails with badInput where there is none to merge.
Result<Network> mergeNetworks(std::span<const Network> networks);

/// How many vessels of the first the second has, too: by name, and from the same place to the same within a
/// tenth of their radii. O(n log n).
std::size_t sharedVessels(const Network& a, const Network& b);

}  // namespace vasa
