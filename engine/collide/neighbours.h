#pragma once
#include <span>
#include <vector>

#include "collide/exclusions.h"

namespace vasa {

/// A way through the network between two tubes: from parameter s of tube i over `gap` metres of other tubes
/// to parameter t of tube j. The arc length between points of the two is then
///   |s' - s| length_i + gap + |t' - t| length_j.
struct TubeLink {
  std::uint32_t i = 0, j = 0;  ///< i < j
  float s = 0, t = 0;
  float gap = 0;
};

/// What one pair of neighbours needs: its links and the lengths of its tubes at rest.
struct NeighbourPair {
  TubePair tubes;
  float lengthI = 0, lengthJ = 0;
  std::uint32_t firstLink = 0, linkCount = 0;
};

/// Tubes that lie close to one another along the network: the arc length between some of their points is
/// below `reach` times the sum of the radii there. They belong together and are left out of detection, as
/// whole tubes: where a vessel folds over itself so tightly, that is a kink (network/kinks.h). Immutable.
class Neighbours {
 public:
  Neighbours() : exclusions_(0) {}
  /// @param lengths  arc length of each tube at rest
  /// @param links    any order; several a pair are fine
  Neighbours(std::span<const float> lengths, std::vector<TubeLink> links, float reach);

  float reach() const { return reach_; }
  std::span<const NeighbourPair> pairs() const { return pairs_; }
  std::span<const TubeLink> links(const NeighbourPair& pair) const {
    return std::span(links_).subspan(pair.firstLink, pair.linkCount);
  }
  /// The same pairs for the detectors.
  const Exclusions& exclusions() const { return exclusions_; }
  /// The entry of a pair, or null.
  const NeighbourPair* find(TubePair pair) const;

 private:
  float reach_ = 2;
  std::vector<TubeLink> links_;
  std::vector<NeighbourPair> pairs_;  // sorted
  Exclusions exclusions_;
};

}  // namespace vasa
