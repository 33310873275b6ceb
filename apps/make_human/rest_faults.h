#pragma once
#include <vector>

#include "network/network.h"

namespace vasa::human {

/// Vessels that at rest run through another or nearly, but for where they meet at a fork, and vessels that
/// fold over themselves in a bend; by number, each once. O(sweeps · log sweeps).
std::vector<VesselId> restFaults(const Network& network);

}  // namespace vasa::human
