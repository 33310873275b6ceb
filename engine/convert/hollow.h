#pragma once
#include <optional>
#include <span>
#include <vector>

#include "convert/source.h"

namespace vasa {

/// A vessel whose wall has an outside and an inside, as segmented walls and solidified surfaces have, without
/// the outside: what is left is the lumen. A piece of the surface is the outside of another where that lies
/// inside it and it lies all along that one; so is a part of a piece that goes on around the openings' rims
/// (convert/wall_faces.h).
/// @param weldTolerance  [m] vertices nearer than this are one
/// @return nothing where nothing is another's outside. O(n log n), and as much for each pair of pieces that
/// could be
std::optional<TriangleMesh> withoutOuterWalls(const TriangleMesh& mesh, float weldTolerance);

/// Which elements are the outside of another one's wall, as lumen and wall of one segmentation are: that one
/// lies inside it and stands off it (a coarser copy does not), is as wide but for the wall, of no other kind
/// that is known, and it lies all along that one. Every element is compared with those whose boxes it holds;
/// parallel.
std::vector<bool> outerWalls(std::span<const SourceElement> elements);

}  // namespace vasa
