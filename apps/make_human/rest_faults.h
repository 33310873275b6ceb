#pragma once
#include <vector>

#include "network/network.h"

namespace vasa::human {

/// Vessels that at rest run through another, or nearly, without sharing a fork with it, and vessels that fold over
/// themselves in a bend; by number, each once. O(sweeps · log sweeps), plus the forks of each pair found.
std::vector<VesselId> restFaults(const Network& network);

}  // namespace vasa::human
