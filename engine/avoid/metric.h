#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace vasa {

/// What a correction of one vessel's points costs: ½ zᵀ W z with W = I + β D2ᵀ D2 (D2: second differences
/// along the vessel), so that a vessel is pushed aside in one smooth bow and not dented. A fixed end counts
/// as z = 0 on and beyond it. Pentadiagonal, factored once (L D Lᵀ).
class BendingMetric {
 public:
  /// @param count  points that may move, at least 0
  /// @param beta   >= 0
  BendingMetric(std::uint32_t count, bool startFixed, bool endFixed, float beta);

  std::uint32_t count() const { return std::uint32_t(pivot_.size()); }
  struct Range {
    std::uint32_t first, last;  ///< half open
  };
  /// Replaces a right-hand side of which only x[given] is not 0 by W⁻¹ times it. That falls off within some
  /// points, and what is below `negligible` of the largest value is left 0. Returns where x is not 0.
  /// O(result).
  Range solveNear(std::span<float> x, Range given, float negligible) const;
  /// zᵀ W z of any z, for a given bending weight: what carrying a shape along costs.
  static float energy(std::span<const float> z, float beta);
  /// How many points long a bow is to either side, about.
  static float bowOf(float beta) { return 3 * std::sqrt(std::sqrt(beta)); }

 private:
  std::vector<float> pivot_, lower1_, lower2_;  // 1/D, and L's two diagonals
};

}  // namespace vasa
