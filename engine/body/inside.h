#pragma once
#include <span>

#include "body/skin_shell.h"
#include "network/network.h"

namespace vasa {

/// Moves points into a body that lie outside its skin, or nearer to it than their radius and than they were
/// in the body that they come from; their neighbours along the vessel come along, half as far each.
/// @param depths  [m] that each point had below the skin it comes from, in the other body's size
/// @param points  as Network::points() [m], moved
/// @return how many points were moved themselves. In parallel; O(points · log triangles)
std::uint32_t moveInside(const Network& network, std::span<const float> depths, const SkinShell& skin,
                         float bodyHeight, std::span<vec4> points);

}  // namespace vasa
