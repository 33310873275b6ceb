#pragma once
#include <cstddef>

#include "collide/box_tree.h"
#include "collide/contact.h"

// The vector code of the fast detector, compiled for every instruction set at hand and chosen at run time
// (Google Highway). All arithmetic that decides is conservative: a rejection and an acceptance are proofs,
// and what remains is left to the branch and bound in double precision. `tubes` is 16 floats a tube: Bezier's
// own layout.
namespace vasa {

/// A group that holds excluded partners of a slot, and which lanes they are.
struct ExcludedLanes {
  std::uint32_t group;
  std::uint32_t lanes;
};

/// Two groups of one level that are to be tested against one another, a <= b.
struct GroupPair {
  std::uint32_t level, a, b;
};

/// One traversal's input and working memory.
struct Traversal {
  BoxTreeView tree;
  const std::uint32_t*
      firstExcluded;              ///< a slot's entries are firstExcluded[slot] .. firstExcluded[slot + 1]
  const ExcludedLanes* excluded;  ///< only groups that do not come before the slot's own
  GroupPair* stack;               ///< room for kGroupPairs more a level than is put there first
  std::size_t stackSize;
  TubePair* candidates;  ///< pairs of tubes whose chord capsules meet; room for `enough` and a group more
  std::size_t candidateCount;
};
constexpr std::size_t kGroupPairs = kGroup * kGroup;  ///< most pairs that two groups can add

/// A piece of tube i from parameter s on against a piece of tube j from t on; both have length 2^-level.
struct PiecePair {
  std::uint32_t i, j;
  float s, t;
  std::uint32_t candidate;  ///< where it came from
};

/// What is known of a pair of pieces: kMeet where the tubes are sure to intersect; else bit 2p + q is set
/// where half p of the first and half q of the second may still meet. No bit: apart.
constexpr std::uint32_t kMeet = 0x10;

struct Kernels {
  /// Fills boxes and capsules of the groups [begin, end) of level 0. Radii are grown by `grow`.
  void (*fitLeaves)(const BoxTreeView& tree, const float* tubes, float grow, std::uint32_t begin,
                    std::uint32_t end);
  /// Fills the boxes of the groups [begin, end) of a level above 0 from the level below.
  void (*fitLevel)(const BoxTreeView& tree, std::uint32_t level, std::uint32_t begin, std::uint32_t end);
  /// Replaces the one pair on the stack, of a level above 0, by its children.
  void (*openNode)(Traversal& traversal);
  /// Takes pairs off the stack until it is empty or there are `enough` candidates.
  void (*traverse)(Traversal& traversal, std::size_t enough);
  /// Halves both pieces and bounds the four pairs of halves by swept spheres; looks at the true curves at the
  /// nearest parameters. verdicts has a place a pair.
  void (*narrow)(const float* tubes, float grow, int level, const PiecePair* pieces, std::size_t count,
                 std::uint8_t* verdicts);
};

/// The best instruction set of this machine.
const Kernels& fastKernels();
/// One lane, plain arithmetic.
const Kernels& scalarKernels();

}  // namespace vasa
