#pragma once
#include <optional>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// A vessel whose wall has an outside and an inside, as segmented walls and solidified surfaces have, without
/// the outside: what is left is the lumen. A piece of the surface is the outside of another where that lies
/// inside it and it lies all along that one; so is a part of a piece that goes on around the openings' rims
/// (convert/wall_faces.h).
/// @param weldTolerance  [m] vertices nearer than this are one
/// @return nothing where nothing is another's outside. O(n log n), and as much for each pair of pieces that
/// could be
std::optional<TriangleMesh> withoutOuterWalls(const TriangleMesh& mesh, float weldTolerance);

}  // namespace vasa
