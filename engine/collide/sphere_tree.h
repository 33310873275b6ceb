#pragma once
#include <span>
#include <vector>

#include "curve/bounds.h"

namespace vasa {

/// The paper's upper level: an 8-ary tree of spheres over one bounding sphere a sweep (Park et al. 2013, §5).
/// Built once at rest, bottom-up: neighbours are merged pair by pair, smallest merged sphere first, three
/// rounds a level. Nodes are always full but for the last of a level, so topology needs no storage: level
/// after level, children before parents, 16 bytes a sphere; 4,030 sweeps have 4,606 spheres. refit() is one
/// linear pass.
class SphereTree {
 public:
  explicit SphereTree(std::span<const Bezier> rest);

  /// Fits every sphere to the tubes' present shape.
  /// @param tubes  as many as at rest, in the same order
  void refit(std::span<const Bezier> tubes);

  static constexpr std::uint32_t kArity = 8;
  std::uint32_t levels() const { return std::uint32_t(start_.size()) - 1; }
  std::uint32_t count(std::uint32_t level) const { return start_[level + 1] - start_[level]; }
  std::span<const Sphere> level(std::uint32_t level) const {
    return std::span(spheres_).subspan(start_[level], count(level));
  }
  /// The tube of a leaf (level 0).
  std::uint32_t tube(std::uint32_t leaf) const { return order_[leaf]; }
  /// Memory of the spheres.
  std::size_t bytes() const { return spheres_.size() * sizeof(Sphere); }

 private:
  std::vector<Sphere> spheres_;
  std::vector<std::uint32_t> start_;  // where each level begins, and the end
  std::vector<std::uint32_t> order_;  // leaf -> tube
};

/// The smallest sphere around two.
Sphere mergedSphere(const Sphere& a, const Sphere& b);

}  // namespace vasa
