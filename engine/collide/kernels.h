#pragma once
#include <cstddef>

#include "collide/box_tree.h"
#include "collide/contact.h"

// The vector code of the fast detector, compiled for every instruction set at hand and chosen at run time
// (Google Highway). All arithmetic that decides is conservative: a rejection and an acceptance are proofs,
// and what remains is left to the branch and bound in double precision. `tubes` is 16 floats a tube: Bezier's
// own layout.
namespace vasa {

/// Pairs of lanes of two groups: bit 8 p + q stands for lane p of the first and lane q of the second.
using LanePairs = std::uint64_t;

/// A group that holds excluded partners of another group's tubes, and which they are.
struct ExcludedGroup {
  std::uint32_t group;
  LanePairs pairs;
};

/// Two groups of one level that are to be tested against one another, a <= b.
struct GroupPair {
  std::uint32_t level, a, b;
};
constexpr std::size_t kGroupPairs = kGroup * kGroup;  ///< most pairs that two groups can add

/// One traversal's input and working memory.
struct Traversal {
  BoxTreeView tree;
  const std::uint32_t*
      firstExcluded;              ///< a group's entries are firstExcluded[group] .. firstExcluded[group + 1]
  const ExcludedGroup* excluded;  ///< only groups that do not come before the group itself
  GroupPair* stack;               ///< room for kGroupPairs more a level than is put there first
  std::size_t stackSize;
  TubePair* candidates;  ///< pairs of slots whose boxes meet; room for `enough` and kGroupPairs more
  std::size_t candidateCount;
};

/// A piece of the tube in slot i from parameter s on against a piece of that in slot j from t on; both have
/// length 2^-level.
struct PiecePair {
  std::uint32_t i, j;
  float s, t;
  std::uint32_t candidate;  ///< where it came from
};

struct Kernels {
  /// Copies the tubes of the groups [begin, end) into the tree's order, radii grown by `grow`, and fills
  /// their boxes and capsules.
  void (*fitLeaves)(const BoxTreeView& tree, const float* tubes, float grow, std::uint32_t begin,
                    std::uint32_t end);
  /// Fills the boxes of the groups [begin, end) of a level above 0 from the level below.
  void (*fitLevel)(const BoxTreeView& tree, std::uint32_t level, std::uint32_t begin, std::uint32_t end);
  /// Replaces the pair on top of the stack, of a level above 0, by its children.
  void (*openNode)(Traversal& traversal);
  /// Takes pairs off the stack until it is empty or there are `enough` candidates.
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
