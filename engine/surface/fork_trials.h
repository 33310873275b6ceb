#pragma once
#include <vector>

#include "surface/fork.h"
#include "surface/fork_memory.h"

namespace vasa {

/// Tries forks at rest and in shapes that the network may be bent to. A fork moves with a few control points
/// that lie close together, so what a motion does to it is an affine map up to bending: the network is
/// squeezed, stretched and sheared along the three axes, radii kept, as joints do to vessels that pass them.
class ForkTrials {
 public:
  /// Both must outlive this.
  ForkTrials(const Network& network, ForkMemory& memory);

  /// One result a fork. Those that the memory knows are not tried.
  std::vector<ForkFolds> foldsOf(std::span<const shared::ForkRecord> forks,
                                 std::span<const shared::ForkBranch> branches);

 private:
  struct Shape {
    std::vector<vec4> points;
    std::vector<quat> frames;
  };
  std::uint64_t keyOf(shared::ForkRecord fork, std::span<const shared::ForkBranch> branches) const;
  shared::ForkRing within(shared::ForkRing ring, std::uint32_t vessel) const;
  std::uint32_t vesselOfPoint(std::uint32_t point) const;
  void strain(std::uint32_t vessel);
  ForkFolds tried(const SweepTable& table, const shared::ForkRecord& fork) const;

  const Network& network_;
  ForkMemory& memory_;
  std::vector<std::uint64_t> keys_;  // of the vessels' shapes
  std::vector<Shape> shapes_;        // the first one at rest; of strained vessels alone
  std::vector<char> strained_;
};

}  // namespace vasa
