#pragma once
#include <optional>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// The two faces of a vessel's wall.
struct WallFaces {
  TriangleMesh outside, inside;
};

/// One piece of surface that goes on around the rims of its openings from a wall's outside to its inside, as
/// that of printed phantoms and solidified surfaces does, cut there. The inside is the largest patch of
/// triangles that look at the surface itself in most directions. Whether the outside lies along it is for the
/// caller to ask: a plexus looks at itself, too.
/// @param piece  welded
/// @return nothing where little of it looks at itself. O(log n) there, O(n log n) otherwise
std::optional<WallFaces> splitAtRims(const TriangleMesh& piece);

}  // namespace vasa
