#pragma once
#include "network/builder.h"

namespace vasa::test {

/// Seeded vessels that wind about in a box one metre high: spans from 1 upwards, radii that change, a third
/// of them hung on the side of an earlier one, some joined in threes.
/// @param vessels  at least 1
Network windingNetwork(std::uint32_t vessels, std::uint32_t seed);

/// Seeded trees of vessels that branch as bodies' do: side branches at all angles and sizes, forks in two and
/// three, vessels joined end to end, several branches at one place. Every third vessel is a trunk.
Network branchingNetwork(std::uint32_t vessels, std::uint32_t seed);

/// What a builder was told, as a network of a body of 1 m.
Network built(const NetworkBuilder& builder);

/// A copy of its points, to be moved.
inline std::vector<vec4> restPoints(const Network& network) {
  return {network.points().begin(), network.points().end()};
}

/// de Boor points of a straight vessel with equal spacing.
std::vector<vec4> straightVessel(vec3 from, vec3 to, float radius, std::uint32_t spans);

/// One straight vessel from (0, 0, 0) to (0, 0, length) whose radius runs from r0 to r1.
Network straightVessel(float length, float r0, float r1, std::uint32_t spans);

/// One straight vessel of 17 spans along x at a height y, of 2 mm radius, whose control points run from
/// -reach to +reach.
Network levelVessel(float reach, float y);

}  // namespace vasa::test
