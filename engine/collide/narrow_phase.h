#pragma once
#include <array>
#include <span>
#include <vector>

#include "collide/kernels.h"

namespace vasa {

/// Settles pairs of tubes whose boxes meet: chord capsules; then swept spheres around ever shorter pieces,
/// one level of all open pairs at a time, so that the vectors stay full; what single precision leaves open
/// goes to the certified search in double. Holds working memory: one object a thread.
class NarrowPhase {
 public:
  struct Statistics {
    std::size_t boxPairs = 0;  ///< pairs that were asked for
    std::array<std::size_t, 8>
        pieces{};  ///< pairs of pieces of length 2^-level that were halved; [0]: capsules that meet
    std::size_t searched = 0;  ///< pairs left to the search in double precision
  };

  /// Appends those that intersect, as ordered pairs of tubes.
  /// @param tubes      pairs of tubes, in any order
  /// @param tolerance  [m] as in tubesIntersect()
  void settle(const Kernels& kernels, const BoxTreeView& tree, std::span<const TubePair> tubes,
              double tolerance, std::vector<TubePair>& pairs);

  Statistics statistics;

 private:
  std::vector<TubePair> meeting_;  // tubes whose capsules meet
  std::vector<PiecePair> pieces_, halves_;
  std::vector<std::uint8_t> settled_;  // by index into meeting_
};

}  // namespace vasa
