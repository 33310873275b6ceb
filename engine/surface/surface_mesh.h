#pragma once
#include "surface/fork.h"

namespace vasa {

/// The whole drawn surface of a network as one indexed mesh: what `export` writes and what a picture shows.
/// Tubes, then caps, then forks, then patches kept from the source; every edge belongs to two triangles. From
/// pose to pose the vertices and what they belong to stay the same, and the number of triangles, too, where
/// forks stay open; a fork's triangles may begin at another vertex of a ring. Some vertices of a stump belong
/// to no triangle.
struct SurfaceMesh {
  std::vector<vec3> positions, normals;  ///< one a vertex [m], unit
  /// Counter-clockwise seen from outside. A triangle belongs to its first vertex's vessel, so that each
  /// vessel begins and ends with whole rings; where three meet, with a loop each.
  std::vector<uvec3> triangles;
  std::vector<std::uint32_t>
      vesselOfVertex;  ///< index into Network::vessels(); a shared ring's is one of its vessels
};

/// @param points      de Boor points of the pose, as Network::points()
/// @param knotFrames  networkFrames() of them (surface/sweep_table.h)
/// O(vertices), parallel; the same for any number of threads.
SurfaceMesh surfaceMesh(const Network& network, std::span<const vec4> points,
                        std::span<const quat> knotFrames, const SweepShape& shape);
/// With a table that is there already.
/// @param fixed  see evaluateFork(); one a fork, or none
SurfaceMesh surfaceMesh(const PosedNetwork& network, const SweepShape& shape,
                        std::span<const ForkSteps> fixed = {});

}  // namespace vasa
