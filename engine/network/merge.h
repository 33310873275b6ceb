#pragma once
#include "core/result.h"
#include "network/network.h"

namespace vasa {

/// One network of several (arteries and veins from two files): vessels and nodes one after the other. The
/// body height is the first one's. Fails with badInput where there is none to merge.
Result<Network> mergeNetworks(std::span<const Network> networks);

}  // namespace vasa
