#pragma once
#include "collide/tube_list.h"

namespace vasa::test {

/// A made-up body of vessels as a plain tube list: body height 1, trees that branch in two inside a trunk,
/// head, arms and legs, three tubes a vessel, C¹ inside a vessel; pose 1 bends the limbs and twists the
/// trunk. Tubes that share an end are excluded. Larger networks have thinner and shorter tubes (∛ of the
/// count), so that every tube has about as many neighbours, whatever the size.
/// @param tubes  exactly so many are made
TubeList makeTubeNetwork(std::uint32_t tubes, std::uint32_t seed);

}  // namespace vasa::test
