#pragma once
#include <memory>
#include <span>
#include <vector>

#include "curve/bezier.h"

namespace vasa {

/// A tube too near to a surface, or inside it.
struct ObstacleContact {
  std::uint32_t tube = 0;
  std::uint32_t triangle = 0;  ///< of the mesh, the nearest
  float s = 0;                 ///< on the tube
  vec3 point{0};               ///< on the surface
  float f = 0;           ///< [m] signed distance of the centre line from the surface, less the radius there
  vec3 normal{0, 0, 1};  ///< unit, the way out: from the surface to the centre line, or back out of the mesh
};

/// A triangle mesh that tubes must not enter (bones, heart), moving with its vertices. Method: an 8-ary box
/// tree over the triangles, its topology fixed at rest, refit each frame; tubes are cut into pieces no longer
/// than about their radius, each held against the triangles near it as a segment with a radius. The sign
/// comes from the angle-weighted normal of the nearest face, edge or corner (Bærentzen, Aanæs 2005): the mesh
/// should be closed and wound outwards; at the rim of an open one the sign is a guess.
class Obstacle {
 public:
  /// @param rest       vertices at rest; they decide the tree's topology
  /// @param triangles  counter-clockwise from outside, indices below rest.size(); copied
  Obstacle(std::span<const vec3> rest, std::span<const uvec3> triangles);
  ~Obstacle();
  Obstacle(Obstacle&&) noexcept;

  /// Refits tree and normals to the present shape, which is copied. @param positions  as many as at rest
  void update(std::span<const vec3> positions);

  /// Every piece of a tube with f < margin, at its deepest sampled place; sorted by tube, then parameter. The
  /// centre line is sampled at piece ends and at the place nearest to the surface, so f is no more than a
  /// fifth of a radius above the piece's least value. Parallel over tubes, the result the same for any number
  /// of threads.
  /// @param margin  [m] >= 0
  /// @param depth   [m] how far inside a centre line is still noticed; larger costs more
  std::span<const ObstacleContact> contacts(std::span<const Bezier> tubes, float margin, float depth);

  /// Distances of points from the surface, on either side of it; `reach` beyond that.
  /// @param near  working memory
  void distances(std::span<const vec3> points, float reach, std::vector<std::uint32_t>& near,
                 std::span<float> distances) const;

  std::uint32_t triangleCount() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa
