#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa {

/// Of a face that is read from a file: cutting takes the square of them at worst.
constexpr std::size_t kMostCorners = 512;

/// Cuts a polygon into triangles that turn as it does: a quadrangle along its shorter diagonal, others by ear
/// clipping (Meisters 1975) in the coordinate plane that they face most. Corners that lie in a line,
/// coincide, or cross over one another cost no triangle: there are always two fewer than corners, so that a
/// closed surface stays closed.
/// @param corners  at least 3
/// @param triangles  numbers of corners, added at the end
/// O(corners · corners that turn inward).
void cutPolygon(std::span<const vec3> corners, std::vector<uvec3>& triangles);

}  // namespace vasa
