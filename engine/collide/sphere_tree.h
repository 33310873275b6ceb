#pragma once
#include <span>
#include <vector>

#include "curve/bounds.h"

namespace vasa {

/// The paper's upper level: an 8-ary tree of spheres over one bounding sphere a sweep (Park et al. 2013, §5).
/// Built once at rest, bottom-up: neighbours are merged pair by pair, smallest merged sphere first, three
/// rounds a level. Nodes are always full but for the last of a level, so topology needs no storage: level
/// after level, children before parents; 4,030 sweeps have 4,606 spheres. A sphere is 8 bytes, half of the
/// paper's: centre and radius in steps of a grid over all tubes, a 32,000th of their extent, the radius
/// rounded up so that it covers the rounding. refit() is one linear pass.
class SphereTree {
 public:
  explicit SphereTree(std::span<const Bezier> rest);

  /// Fits every sphere to the tubes' present shape.
  /// @param tubes  as many as at rest, in the same order
  void refit(std::span<const Bezier> tubes);

  static constexpr std::uint32_t kArity = 8;
  std::uint32_t levels() const { return std::uint32_t(start_.size()) - 1; }
  std::uint32_t count(std::uint32_t level) const { return start_[level + 1] - start_[level]; }
  Sphere sphere(std::uint32_t level, std::uint32_t node) const {
    return unpacked(spheres_[start_[level] + node]);
  }
  /// The tube of a leaf (level 0).
  std::uint32_t tube(std::uint32_t leaf) const { return order_[leaf]; }
  /// Memory of the spheres.
  std::size_t bytes() const { return spheres_.size() * sizeof(Packed); }

 private:
  struct Packed {
    std::uint16_t x, y, z, radius;
  };
  void chooseGrid(std::span<const Bezier> tubes);
  Packed packed(const Sphere& sphere) const;
  Sphere unpacked(const Packed& p) const {
    return {corner_ + step_ * vec3(p.x, p.y, p.z), step_ * float(p.radius)};
  }

  std::vector<Packed> spheres_;
  vec3 corner_{0};
  float step_ = 1;
  std::vector<std::uint32_t> start_;  // where each level begins, and the end
  std::vector<std::uint32_t> order_;  // leaf -> tube
};

/// The smallest sphere around two.
Sphere mergedSphere(const Sphere& a, const Sphere& b);

}  // namespace vasa
