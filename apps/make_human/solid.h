#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "body/body.h"
#include "mesh/triangle_tree.h"

namespace vasa::human {

/// What a closed mesh encloses. Pieces that overlap one another, or themselves as a bent skin does, enclose
/// their union. Immutable; queries may run on many threads.
class Solid {
 public:
  /// @param mesh  must outlive this and not change
  explicit Solid(const TriangleMesh& mesh);

  struct Place {
    float distance = 0;  ///< [m] from the nearest triangle: negative inside
    vec3 outwards{0};    ///< unit
  };
  /// Nothing if p lies outside and farther than `within`; inside, farther than that, outwards is zero.
  std::optional<Place> at(vec3 p, float within) const;

  const Aabb& bounds() const { return box_; }

  /// How often the surface goes around p: a ray's signed crossings.
  int winding(vec3 p) const;

  /// Whether p lies inside with no triangle nearer than `depth`. It looks through the grid's cells around p
  /// and plants no tree: for depths of a cell or so, where few places are asked about.
  bool isDeep(vec3 p, float depth) const;

 private:
  std::size_t column(float x, float y) const;
  bool isFar(vec3 p, float within) const;
  const TriangleTree& tree() const;

  const TriangleMesh& mesh_;
  mutable std::once_flag planted_;
  mutable std::unique_ptr<TriangleTree> tree_;  // built when first asked for
  Aabb box_;
  mutable std::once_flag cleared_;
  mutable std::vector<std::atomic<float>>
      clear_;  // of coarse cells: how far their middles are outside; once asked for
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_, triangles_;  // those over each cell of a grid across the ray
};

}  // namespace vasa::human
