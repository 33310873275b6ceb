#pragma once
#include "core/result.h"
#include "network/network.h"

namespace vasa {

/// The same vessels, nodes and patches with other points; patches follow their rings when they are drawn.
/// Fails as NetworkBuilder::build does.
/// @param points      as network.points()
/// @param bodyHeight  [m]
Result<Network> reshapeNetwork(const Network& network, std::span<const vec4> points, float bodyHeight);

}  // namespace vasa
