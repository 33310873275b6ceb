#pragma once
#include <span>

#include "math/capsule.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"

namespace vasa {

/// A surface that may be torn or a piece of another, ready to be asked where its inside is.
class LooseWall {
 public:
  /// @param mesh  every triangle of three different vertices (mesh/weld.h), looking outward
  /// (convert/wall_sides.h)
  explicit LooseWall(TriangleMesh mesh);
  LooseWall(const LooseWall&) = delete;
  LooseWall& operator=(const LooseWall&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  float distance(vec3 p, float within) const { return tree_.nearest(p, within).distance; }
  /// Its winding number, about 1 inside.
  float inside(vec3 p) const { return winding_.at(p); }

 private:
  TriangleMesh mesh_;
  TriangleTree tree_;
  WindingNumber winding_;
};

/// The outer wall of several surfaces together, in a box: where they overlap what lies inside another goes,
/// where one is torn a skin closes it, and pieces whose open ends face one another become one. Their own wall
/// elsewhere, to within `tolerance`. Closed and manifold, except at the box. Method: the distance to the
/// surfaces, its sign from the sum of their winding numbers (Jacobson, Kavan, Sorkine-Hornung 2013),
/// polygonised in tetrahedra, six to a cell.
/// @param cores  are inside, too, where walls have gaps
/// @param cell   [m] coarser where the box would hold more than some 200,000 of them
TriangleMesh joinedWall(std::span<const LooseWall* const> walls, std::span<const Capsule> cores,
                        const Aabb& box, float cell);

}  // namespace vasa
