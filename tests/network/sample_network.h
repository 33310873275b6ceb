#pragma once
#include "network/builder.h"
#include "support/networks.h"

namespace vasa::test {

/// A trunk with a side branch at mid-height, a fork at its top into two, and a vein apart from it:
/// vessels 0 trunk, 1 side branch, 2 and 3 fork arms, 4 vein.
NetworkBuilder sampleBuilder();

}  // namespace vasa::test
