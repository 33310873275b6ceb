#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <span>

#include "math/aabb.h"
#include "math/types.h"

namespace vasa {

class ByteReader;
class ByteWriter;

/// The signed distance from a rigid closed surface, sampled near it: bricks of 4x4x4 cells that share their
/// corners, values in between trilinear. Error: h²/8R over a surface that bends with radius R, up to half a
/// cell at sharp edges. A look-up costs some nanoseconds, however many triangles there are; that is what it
/// is for. A brick is filled when it is first looked at, by whichever thread comes first; what is in it does
/// not depend on that.
class DistanceField {
 public:
  struct Options {
    float cell = 0.0025f;  ///< h [m]
    float band = 0.006f;   ///< [m], at least 2 cells
  };

  /// @param triangles  counter-clockwise from outside; holes and overlaps are borne (mesh/winding_number.h)
  /// O(triangles); filling all bricks would be O(area · band / cell³).
  DistanceField(std::span<const vec3> positions, std::span<const uvec3> triangles, Options options);
  ~DistanceField();
  DistanceField(DistanceField&&) noexcept;

  /// What is filled so far, for a later run.
  void save(ByteWriter& out) const;
  /// The field of the same surface and options with what save() gave; nothing where that is not whole.
  static std::optional<DistanceField> restored(std::span<const vec3> positions,
                                               std::span<const uvec3> triangles, Options options,
                                               ByteReader& in);
  std::uint32_t filledBricks() const;

  struct Sample {
    float distance;  ///< as distance()
    vec3 gradient;   ///< of the trilinear field; 0 beyond the band
  };
  Sample at(vec3 point) const;
  /// Outside beyond the band: no less than the band, no more than the distance. Inside beyond it: -band. The
  /// slope along an axis is at most 1.
  float distance(vec3 point) const;
  /// The same for the centres of some balls at once, faster than one after the other. @param out  as many
  void distances(std::span<const vec4> balls, std::span<float> out) const;
  /// No more than the distance from the surface, also far beyond the band; 0 inside.
  float clearance(vec3 point) const;

  /// Where the field may be below +band.
  const Aabb& box() const { return box_; }
  float band() const { return options_.band; }
  std::size_t bytes() const;

 private:
  static constexpr int kBrick = 4, kCorners = kBrick + 1, kValues = kCorners * kCorners * kCorners;
  // Of a brick: where its values are, or what else it is. Outside, the last byte tells how many bricks off
  // the nearest with values is.
  static constexpr std::uint32_t kOutside = 0xffffff00u, kInside = 0xfffffeffu, kEmpty = 0xfffffefeu,
                                 kBeingFilled = 0xfffffefdu, kUndecided = 0xfffffefcu;
  struct Exact;
  struct Unfilled {};
  DistanceField(std::span<const vec3> positions, std::span<const uvec3> triangles, Options options, Unfilled);
  struct Cell {
    const float* values;  // of the brick, or null
    float beyond;         // where it is null
    ivec3 corner;
    vec3 share;
  };
  Cell cellAt(vec3 point) const;
  static float distanceIn(const Cell& cell);
  std::size_t indexOf(ivec3 brick) const {
    return std::size_t((brick.z * counts_.y + brick.y) * counts_.x + brick.x);
  }
  std::uint32_t brick(ivec3 at) const { return bricks_[indexOf(at)].load(std::memory_order_acquire); }
  void set(ivec3 at, std::uint32_t what) { bricks_[indexOf(at)].store(what, std::memory_order_relaxed); }
  const Exact& exact() const;
  void makeRoom();
  void markBand();
  std::uint32_t fill(ivec3 brick) const;
  void measure(std::span<const vec3, kValues> corners, std::span<float, kValues> distances) const;
  void giveSigns(std::span<const vec3, kValues> corners, std::span<float, kValues> distances) const;
  void sortOutInside();
  void measureRings();

  Options options_;
  Aabb box_;
  vec3 origin_{0};
  ivec3 counts_{0};  // bricks a side
  std::size_t brickCount_ = 0;
  std::unique_ptr<Exact> exact_;
  std::unique_ptr<std::atomic<std::uint32_t>[]> bricks_;
  // kValues a brick, in the order of filling: what is looked at lies together, and the rest takes no memory.
  std::unique_ptr<float[]> values_;
  std::unique_ptr<std::atomic<std::uint32_t>> filled_;  // bricks
};

}  // namespace vasa
