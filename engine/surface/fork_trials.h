#pragma once
#include <unordered_map>
#include <vector>

#include "surface/fork.h"

namespace vasa {

/// Where a fork folds, in triangles; the lesser of two is the better fork.
struct ForkFolds {
  std::uint32_t rest = 0;      ///< at rest, 8 quads around
  std::uint32_t others = 0;    ///< at rest, other numbers of quads around
  std::uint32_t strained = 0;  ///< in strained shapes of the network, 8 quads around
  bool none() const { return rest + others + strained == 0; }
  auto operator<=>(const ForkFolds&) const = default;
};

/// Tries forks at rest and in shapes that the network may be bent to. A fork moves with a few control points
/// that lie close together, so what a motion does to it is an affine map up to bending: the network is
/// squeezed, stretched and sheared along the three axes, radii kept, as joints do to vessels that pass them.
class ForkTrials {
 public:
  explicit ForkTrials(const Network& network);

  /// One result a fork. Those of earlier calls are remembered.
  std::vector<ForkFolds> foldsOf(std::span<const shared::ForkRecord> forks,
                                 std::span<const shared::ForkBranch> branches);

 private:
  struct Shape {
    std::vector<vec4> points;
    std::vector<quat> frames;
  };
  ForkFolds tried(const SweepTable& table, const shared::ForkRecord& fork) const;

  std::vector<Shape> shapes_;  // the first one at rest
  std::unordered_map<std::uint64_t, ForkFolds> known_;
};

}  // namespace vasa
