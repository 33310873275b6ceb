#pragma once
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace vasa::human {

/// The skin as an elastic sheet: it wants to keep the shape that it has at rest, place by place, and gives
/// way to what lies under it.
class SkinSheet {
 public:
  /// A vertex has to stay beyond a plane: dot(x, normal) >= offset.
  struct Floor {
    vec3 normal{0};
    float offset = 0;
    bool bounds() const { return normal != vec3(0); }
  };

  /// @param rest  must outlive this and not change; closed
  explicit SkinSheet(const TriangleMesh& rest);

  std::span<const std::uint32_t> neighbours(std::size_t vertex) const {
    return std::span(neighbours_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

  /// Lets the sheet come nearer to equilibrium from where it is. Method: as-rigid-as-possible energy (Sorkine
  /// and Alexa 2007) with equal weights, Jacobi steps, so that what is far from any bend stays where it is.
  /// @param positions  [m] one a vertex, in and out
  /// @param turns      how each vertex's surroundings are turned about; in and out
  /// @param floors     one a vertex
  void relax(std::span<vec3> positions, std::span<quat> turns, std::span<const Floor> floors,
             int steps) const;

 private:
  std::size_t find(std::uint32_t vertex, std::uint32_t neighbour) const;  // in neighbours_

  const TriangleMesh& rest_;
  std::vector<std::uint32_t> first_, neighbours_;
  std::vector<std::uint32_t> edges_;  // the edge's number, which is the same from both its ends
};

}  // namespace vasa::human
