#pragma once
#include <optional>
#include <span>
#include <vector>

#include "surface/fork_item.h"
#include "surface/fork_memory.h"
#include "surface/fork_plan.h"
#include "surface/fork_record.h"
#include "surface/vessel_line.h"

namespace vasa {

/// What a line comes to, along it: tubes and forks. Numbers of branches count within.
struct LinePiece {
  std::vector<TubeStretch> tubes;
  std::vector<ForkItem> items;  ///< one a fork
  std::vector<shared::ForkRecord> forks;
  std::vector<shared::ForkBranch> branches;
  std::vector<std::optional<ForkFolds>> folds;  ///< of each fork; nothing before it was tried

  /// Adds one of its forks to others.
  void addFork(std::size_t index, std::vector<shared::ForkRecord>& allForks,
               std::vector<shared::ForkBranch>& allBranches) const;
};

/// @param lines   all of the network  @param index  of the line
/// @param rings   how far from its first and its last end its tube begins, in the wall of what it leaves;
/// nothing: in a cap
/// @param items   what is on it, in order, with its room
/// @param before  what it came to with other items: forks that are the same keep their records and folds
LinePiece pieceOf(const Network& network, std::span<const VesselLine> lines, std::uint32_t index,
                  std::array<std::optional<float>, 2> rings, std::span<const ForkItem> items,
                  const LinePiece& before);

}  // namespace vasa
