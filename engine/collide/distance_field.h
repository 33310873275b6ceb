#pragma once
#include <span>
#include <vector>

#include "math/aabb.h"
#include "math/types.h"

namespace vasa {

/// The signed distance from a rigid closed surface, sampled near it: bricks of 4x4x4 cells that share their corners,
/// values in between trilinear. Beyond the band it is +band outside and -band inside. Error: h²/8R over a surface
/// that bends with radius R, up to half a cell at sharp edges. A look-up costs some nanoseconds, however many triangles
/// there are; that is what it is for (collide/obstacle.h is exact, and a thousand times slower).
class DistanceField {
 public:
  struct Options {
    float cell = 0.0025f;  ///< h [m]
    float band = 0.006f;   ///< [m], at least 2 cells
  };

  /// @param triangles  counter-clockwise from outside; the surface should be closed (see Obstacle), but equal vertices
  ///                   may be several
  /// O(area · band / cell³), in parallel.
  DistanceField(std::span<const vec3> positions, std::span<const uvec3> triangles, Options options);

  struct Sample {
    float distance;  ///< [m]
    vec3 gradient;   ///< of the trilinear field; 0 beyond the band
  };
  Sample at(vec3 point) const;
  float distance(vec3 point) const;

  /// Where the field may be below +band.
  const Aabb& box() const { return box_; }
  float band() const { return options_.band; }
  std::size_t bytes() const;

 private:
  static constexpr int kBrick = 4, kCorners = kBrick + 1, kValues = kCorners * kCorners * kCorners;
  static constexpr std::uint32_t kOutside = 0xffffffffu, kUndecided = 0xfffffffeu, kInside = 0xfffffffdu;
  struct Cell {
    const float* values;  // of the brick, or null
    float beyond;         // where it is null
    ivec3 corner;
    vec3 share;
  };
  Cell cellAt(vec3 point) const;
  std::uint32_t& brick(ivec3 at) { return bricks_[std::size_t((at.z * counts_.y + at.y) * counts_.x + at.x)]; }
  std::uint32_t brick(ivec3 at) const { return bricks_[std::size_t((at.z * counts_.y + at.y) * counts_.x + at.x)]; }
  void markBand(std::span<const vec3> positions, std::span<const uvec3> triangles);
  void fill(std::span<const vec3> positions, std::span<const uvec3> triangles);
  void sortOutInside();

  Options options_;
  Aabb box_;
  vec3 origin_{0};
  ivec3 counts_{0};                    // bricks a side
  std::vector<std::uint32_t> bricks_;  // number of its values, or one of the three
  std::vector<float> values_;          // kValues a brick
};

}  // namespace vasa
