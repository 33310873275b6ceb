#pragma once
#include <vector>

#include "math/aabb.h"

namespace vasa {

/// Indexed triangles. Every index is below positions.size() (readers check that).
struct TriangleMesh {
  std::vector<vec3> positions;   ///< [m]
  std::vector<uvec3> triangles;  ///< counter-clockwise seen from outside

  bool empty() const { return triangles.empty(); }
  Aabb bounds() const;
  /// At right angles to a triangle, outward, twice its area long.
  vec3 areaNormal(const uvec3& t) const {
    return glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
  }
  /// Total area [m²].
  double area() const;
  /// Volume enclosed by a closed, outward-oriented mesh [m³] (divergence theorem).
  double volume() const;
  /// Bytes of a vertex (12) and triangle (12) table: what "mesh_bytes" counts.
  std::size_t bytes() const { return positions.size() * sizeof(vec3) + triangles.size() * sizeof(uvec3); }
};

/// Area-weighted unit normals, one a vertex; (0, 0, 1) where no triangle gives one.
std::vector<vec3> vertexNormals(const TriangleMesh& mesh);

}  // namespace vasa
