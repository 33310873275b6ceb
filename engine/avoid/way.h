#pragma once
#include <vector>

#include "avoid/room.h"

namespace vasa {

/// How far from a stretch its way may lead, and how much more room than it needs it takes where it may [m].
constexpr float kWayAside = 0.015f, kWayRoom = 5e-4f;

/// The shortest way between a stretch's ends on which a ball has room, near where the stretch is rather than far: A*
/// (Hart, Nilsson, Raphael 1968) over a grid, then pulled straight where there is room. Near the ends, which are where
/// they are, room may lack. Deterministic.
/// @param need  [m] the ball's radius
/// @return as many places as the line has, at equal distances; none where there is no way.
///         O(places of the grid looked at), some milliseconds
std::vector<vec3> findWay(const StretchLine& line, const Room& room, float need);

/// Where on a way each place of a line belongs, in order along both, by number and share: least squared distances in
/// all (dynamic time warping, Sakoe, Chiba 1978), smoothed. Ends belong to ends. O(line · way)
std::vector<float> placesAlong(std::span<const vec3> way, std::span<const vec3> line);

}  // namespace vasa
