#pragma once
#include <cstddef>

#include "collide/box_tree.h"
#include "collide/contact.h"

// The vector code of the fast detector, compiled for every instruction set at hand and chosen at run time
// (Google Highway). All arithmetic that decides is conservative: a rejection and an acceptance are proofs,
// and what remains is left to the branch and bound in double precision.
namespace vasa {

/// Pairs of lanes of two groups: bit 8 p + q stands for lane p of the first and lane q of the second.
using LanePairs = std::uint64_t;

/// Groups that hold excluded partners of another group's tubes, and which they are. Most groups have no more
/// than four.
struct ExcludedGroups {
  std::uint32_t group[4];  ///< filled up with kNoGroup
  LanePairs pairs[4];
};
constexpr std::uint32_t kNoGroup = ~0u;

/// Two groups of one level that are to be tested against one another, a <= b.
struct GroupPair {
  std::uint32_t level, a, b;
};
constexpr std::size_t kGroupPairs = kGroup * kGroup;  ///< most pairs that two groups can add
constexpr std::size_t kLeafBatch = 128;  ///< pairs of leaves that are tested in one go, or a few more
constexpr std::size_t kMostAdded =
    (kLeafBatch + kGroupPairs) * kGroupPairs;  ///< most candidates that they can add

/// One traversal's input and working memory.
struct Traversal {
  BoxTreeView tree;
  const std::uint32_t*
      firstExcluded;               ///< a group's entries are firstExcluded[group] .. firstExcluded[group + 1]
  const ExcludedGroups* excluded;  ///< only groups that do not come before the group itself
  GroupPair* stack;                ///< room for kGroupPairs more a level than is put there first
  std::size_t stackSize;
  TubePair* candidates;  ///< tubes whose boxes meet; room for `enough` and kMostAdded more
  std::size_t candidateCount;
};

/// A piece of tube i from parameter s on against a piece of tube j from t on; both have length 2^-level.
struct PiecePair {
  std::uint32_t i, j;
  float s, t;
  std::uint32_t candidate;  ///< where it came from
};

struct Kernels {
  /// Fills the boxes of the groups [begin, end) of level 0.
  void (*fitLeaves)(const BoxTreeView& tree, std::uint32_t begin, std::uint32_t end);
  /// Fills the boxes of the groups [begin, end) of a level above 0 from the level below.
  void (*fitLevel)(const BoxTreeView& tree, std::uint32_t level, std::uint32_t begin, std::uint32_t end);
  /// Replaces the pair on top of the stack, of a level above 0, by its children whose boxes meet and of which
  /// one, at least, holds something that moved.
  void (*openNode)(Traversal& traversal);
  /// Takes pairs off the stack until it is empty or there are `enough` candidates, of which one has moved.
  void (*traverse)(Traversal& traversal, std::size_t enough);
  /// The candidates whose chord capsules meet, as whole tubes, numbered from 0. @param pieces  room for count
  /// + 1
  std::size_t (*meetCapsules)(const BoxTreeView& tree, const TubePair* candidates, std::size_t count,
                              PiecePair* pieces);
  /// Halves both pieces, bounds the four pairs of halves by swept spheres, and looks at the true curves at
  /// the nearest parameters. Sets settled[candidate] where two tubes are sure to intersect, and returns the
  /// pairs of halves of the others that may still meet. @param halves  room for 4 count + 4
  std::size_t (*narrow)(const BoxTreeView& tree, int level, const PiecePair* pieces, std::size_t count,
                        std::uint8_t* settled, PiecePair* halves);
};

/// The best instruction set of this machine.
const Kernels& fastKernels();
/// One lane, plain arithmetic.
const Kernels& scalarKernels();

}  // namespace vasa
