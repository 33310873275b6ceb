#pragma once
#include "make_human/rig.h"
#include "network/network.h"

namespace vasa::human {

/// The network of vessels.csv on the rig's body. @param bodyHeight  [m]
Result<Network> makeVessels(const std::filesystem::path& vessels, const Rig& rig, float bodyHeight);

}  // namespace vasa::human
