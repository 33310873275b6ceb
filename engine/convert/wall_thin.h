#pragma once
#include "convert/wall_cut.h"

namespace vasa {

/// A piece with fewer triangles that stays within about `error` [m] of it, loops too.
/// Method: vertices move onto a neighbour, where the surface stays one, no triangle turns over or becomes a
/// needle, and the way to the new triangles' planes adds up to no more than `error`. O(triangles · passes).
WallPiece thinned(const WallPiece& wall, float error);

}  // namespace vasa
