#pragma once
#include <optional>

#include "mesh/boundary.h"

namespace vasa {

/// The sections of an unbranched tube whose vertices lie in rings, as a modeller or a sweep makes them.
/// Method: from an end (a border loop, or a vertex that a fan closes the tube with) the vertices are taken in
/// layers of equal edge distance. In a structured tube each layer is one closed loop; accepted where at least
/// `kRingShare` of the vertices lie in such loops and all of them follow one another. Centre and radius are
/// those of the loop's area as seen along the axis; the first and last sections lie on the ends of the
/// surface.
/// @param loops  boundaryLoops of the mesh
/// @returns      at least 3 sections, or nothing where the mesh is not structured so. O(n) for each of at
/// most
///               four ends tried.
constexpr float kRingShare = 0.85f;
std::optional<std::vector<vec4>> traceRings(const TriangleMesh& mesh, const MeshEdges& edges,
                                            std::span<const BoundaryLoop> loops);

}  // namespace vasa
