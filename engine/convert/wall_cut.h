#pragma once
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// A plane across a vessel.
struct WallOpening {
  vec3 centre{0}, outward{0, 0, 1};  ///< on the axis; unit, away from what is cut out
  float radius = 0;                  ///< that the wall should have there
};

/// Why a piece of wall could not be cut out.
enum class WallFault {
  none,
  noWall,  ///< no contour of the surface goes around an opening at about its radius
  apart,   ///< the openings are on surfaces that do not hang together
  torn,    ///< the wall between them has holes, or edges of more than two triangles
  open,    ///< it goes on elsewhere, or has a handle
  crowded  ///< the cuts cross
};

/// The wall between openings.
struct WallPiece {
  WallFault fault = WallFault::noWall;
  TriangleMesh mesh;  ///< the loops' vertices first, each loop counter-clockwise about its outward direction
  std::vector<std::uint32_t> loops;  ///< vertices of each opening's loop
};

/// Cuts a surface along its contours in the openings' planes and takes the piece between them: a sphere with
/// as many holes as there are openings, its triangles counter-clockwise from outside. O(triangles + near ones
/// · log).
WallPiece cutWall(const TriangleMesh& surface, std::span<const WallOpening> openings);

}  // namespace vasa
