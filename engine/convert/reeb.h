#pragma once
#include "convert/axes.h"
#include "mesh/edges.h"

namespace vasa {

/// The Reeb graph of a function on a mesh, cut into bands of equal height: a node where the surface between
/// two levels ends or splits, and chains of contours between nodes. A chain's points are the contours' mean
/// points with perimeter / 2 pi. Method: the pieces of triangles inside a band are united across shared edges
/// (non-manifold ones too); pieces of neighbouring bands meet in a contour. Exact for the function
/// interpolated linearly in the triangles.
/// @param value  one a vertex, finite
/// @param step   band height, > 0, in the function's unit (metres for distances)
/// O(pieces), pieces = sum over triangles of the bands that they reach.
AxisGraph reebGraph(const TriangleMesh& mesh, const MeshEdges& edges, std::span<const float> value,
                    float step);

}  // namespace vasa
