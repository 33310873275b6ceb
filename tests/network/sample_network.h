#pragma once
#include "network/builder.h"

namespace vasa::test {

/// de Boor points of a straight vessel with equal spacing.
std::vector<vec4> straightVessel(vec3 from, vec3 to, float radius, std::uint32_t spans);

/// A trunk with a side branch at mid-height, a fork at its top into two, and a vein apart from it:
/// vessels 0 trunk, 1 side branch, 2 and 3 fork arms, 4 vein.
NetworkBuilder sampleBuilder();

}  // namespace vasa::test
