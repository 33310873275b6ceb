#pragma once
#include <memory>
#include <span>
#include <vector>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"

namespace vasa {

/// Finds where a network's tubes run through one another, and knows which did so at rest already.
///
/// Tubes near one another along the network (collide/neighbours.h) are left out: the search between them has no bound
/// on its memory where the nearest points lie on the limit of what counts. Two other tubes that
/// overlap at rest may stay as deep as they are there, no deeper: `allowed` is their depth at rest.
class Interference {
 public:
  /// @param network  must outlive this
  explicit Interference(const Network& network);

  struct Place {
    Contact contact;
    float allowed = 0;    ///< [m] <= 0: the pair's f at rest, where that is negative
    bool neighbours = false;
    /// How much deeper than it may be [m]; > 0 is interference.
    float excess() const { return allowed - contact.f; }
  };

  /// Every pair of tubes with f < margin in the given shape, sorted by pair; valid until the next call.
  /// @param points  as Network::points()
  /// @param which   the neighbours to look at; they take longer than all other pairs together
  enum class Watch { allNeighbours, neighboursThatMetLastTime };
  std::span<const Place> find(std::span<const vec4> points, float margin, Watch which = Watch::allNeighbours);

  const NetworkTubes& layout() const { return layout_; }
  /// The shape of the last find(), and that at rest.
  std::span<const Bezier> tubes() const { return tubes_; }
  std::span<const Bezier> restTubes() const { return rest_; }
  /// Pairs that overlap at rest, and how many of them are neighbours, which are never looked at again.
  std::size_t restPairCount() const { return restPairs_.size() + restNeighbours_; }
  std::size_t restNeighbourCount() const { return restNeighbours_; }

 private:
  struct RestPair {
    TubePair tubes;
    float f;
  };
  void search(float margin, Watch which);
  void searchNeighbours(float margin, Watch which);
  float allowed(TubePair pair) const;

  NetworkTubes layout_;
  std::vector<Bezier> rest_, tubes_;
  std::unique_ptr<TubeDetector> detector_;
  std::vector<RestPair> restPairs_;  // sorted
  std::vector<NeighbourPair> watched_;  // neighbours that are apart at rest where points count
  std::size_t restNeighbours_ = 0;
  std::vector<char> meets_;      // one a watched pair
  std::vector<std::uint32_t> met_;  // of the watched pairs, when all were looked at last
  std::vector<Place> places_;
};

}  // namespace vasa
