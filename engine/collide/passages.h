#pragma once
#include <array>
#include <span>
#include <vector>

#include "collide/exclusions.h"
#include "curve/bezier.h"
#include "math/aabb.h"

namespace vasa {

/// Two tubes whose centre lines pass through one another on the way from one shape to the next.
struct Passage {
  std::uint32_t i = 0, j = 0;  ///< i < j
  float s = 0, t = 0;          ///< parameters on tubes i and j
  float time = 0;              ///< share of the way, 0 to 1
};

/// Finds what passes through what between two shapes of the same tubes, whether or not anything overlaps in
/// either: what certificates of single shapes cannot tell. Every point goes straight from where it was to
/// where it is; what goes along with a turn of less than 180 degrees keeps its order on that way.
///
/// Method: a box tree whose nodes hold the hulls in both shapes. What lies above something else along an axis
/// in both shapes does so all the way, however far both go. Then halves of both curves, until each is as
/// straight as leaves no doubt (its chord strays by less than a quarter of the radii, so that chords pass
/// through one another only where tubes that overlap in neither shape do), and the roots of the cubic that
/// tells when two chords lie in one plane, in double precision. The same whatever the number of threads.
class PassageSearch {
 public:
  /// @param rest        decides the tree's topology  @param exclusions  must outlive this
  PassageSearch(std::span<const Bezier> rest, const Exclusions& exclusions);

  /// Sorted by pair, then by time; valid until the next call. Costs a detection and a half.
  /// @param before, after  as many tubes as at rest, in the same order
  std::span<const Passage> find(std::span<const Bezier> before, std::span<const Bezier> after);

 private:
  static constexpr std::size_t kShapes = 2;
  using Hull = std::array<Aabb, kShapes>;  // without the radii
  static constexpr std::uint32_t kArity = 8;
  void meet(std::uint32_t slot, std::size_t level, std::uint32_t node, std::vector<Passage>& found) const;

  const Exclusions* exclusions_;
  std::vector<std::uint32_t> order_;      // slot -> tube
  std::vector<std::vector<Hull>> hulls_;  // by level: of single tubes, of eight, of 64 ...
  std::span<const Bezier> before_, after_;
  std::vector<std::vector<Passage>> own_;  // a slot each
  std::vector<Passage> found_;
};

}  // namespace vasa
