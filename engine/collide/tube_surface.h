#pragma once
#include <span>
#include <vector>

#include "curve/bezier.h"

namespace vasa {

/// Tubes as a mesh of m x n quads each, two triangles a quad, without caps: what hierarchies over triangles
/// are built on (collide/box_hierarchy.h). A tube's vertices follow one another, ring after ring; neighbours
/// share none.
class TubeSurface {
 public:
  /// @param around  m >= 3  @param along  n >= 1
  TubeSurface(std::uint32_t around, std::uint32_t along);

  std::uint32_t verticesPerTube() const { return around_ * (along_ + 1); }
  std::uint32_t trianglesPerTube() const { return std::uint32_t(triangles_.size()); }
  /// Vertices of triangle t of n.
  uvec3 triangle(std::uint32_t tube, std::uint32_t t) const {
    return triangles_[t] + uvec3(tube * verticesPerTube());
  }

  /// The vertices of tubes in some shape: rings about rotation-minimising frames (curve/frame.h).
  /// @param positions  [m] resized to tubes.size() · verticesPerTube()
  void shape(std::span<const Bezier> tubes, std::vector<vec3>& positions) const;

  /// A vertex and an index table of so many tubes, as TriangleMesh::bytes().
  std::size_t bytes(std::size_t tubes) const {
    return tubes * (verticesPerTube() * sizeof(vec3) + trianglesPerTube() * sizeof(uvec3));
  }

 private:
  std::uint32_t around_, along_;
  std::vector<uvec3> triangles_;  // of the first tube
};

}  // namespace vasa
