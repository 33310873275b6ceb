#pragma once
#include "make_human/grow.h"
#include "make_human/motion_probe.h"
#include "make_human/rig.h"
#include "make_human/surroundings.h"
#include "network/network.h"

namespace vasa::human {

/// The network of vessels.csv and growth.csv on the rig's body. What a pose of the clips would bring out of
/// the skin is laid deeper, and if it is a grown vessel, left out, as is a grown one that at rest kinks or
/// touches another. @param bodyHeight  [m]
Result<Network> makeVessels(const std::filesystem::path& tables, const Rig& rig, const Surroundings& around,
                            std::span<const BoneForm> organs, const MotionProbe& probe, float bodyHeight,
                            const GrowOptions& options);

}  // namespace vasa::human
