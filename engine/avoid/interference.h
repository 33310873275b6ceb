#pragma once
#include <memory>
#include <span>
#include <vector>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"

namespace vasa {

/// Whether two tubes are near one another at a place: no further apart than the sum of their radii, nor 5 mm.
bool isNear(const Contact& at, std::span<const Bezier> tubes);

/// Finds where a network's tubes run through one another, and knows which did so at rest already.
///
/// Tubes near one another along the network (collide/neighbours.h) are left out: they belong together. Two
/// other tubes that overlap at rest may stay as deep as they are there, no deeper: `allowed` is their f at
/// rest.
class Interference {
 public:
  /// @param network  must outlive this
  explicit Interference(const Network& network);

  struct Place {
    Contact contact;
    float allowed = 0;  ///< [m] <= 0: the pair's f at rest, where that is negative
    /// How much deeper than it may be [m]; > 0 is interference.
    float excess() const { return allowed - contact.f; }
    bool interferes() const { return excess() > (allowed < 0 ? kRestTolerance : 0); }
  };

  /// Every pair of tubes with f < margin in the given shape, sorted by pair; valid until the next call.
  /// @param margin  [m] >= 0; at 0 these are the tubes that overlap
  /// @param points  as Network::points()
  std::span<const Place> find(std::span<const vec4> points, float margin = 0);

  /// A tube each: 1 where it is not what it was at the find() before the last, whatever their margins.
  std::span<const char> moved() const { return detector_->moved(); }

  /// A pair's f at rest [m], where that is negative; otherwise 0.
  float allowed(TubePair pair) const;

  const NetworkTubes& layout() const { return layout_; }
  /// The shape of the last find(), and that at rest.
  std::span<const Bezier> tubes() const { return tubes_; }
  std::span<const Bezier> restTubes() const { return rest_; }
  /// Pairs that overlap at rest, and pairs that are left out as neighbours.
  std::size_t restPairCount() const { return restPairs_.size(); }
  std::size_t neighbourCount() const { return layout_.neighbours().pairCount(); }
  /// Pairs that lay near one another at rest, with the places where they came nearest, sorted by pair. Ends
  /// what find() has returned.
  std::vector<Contact> findNearAtRest();

 private:
  struct RestPair {
    TubePair tubes;
    float f;
  };
  NetworkTubes layout_;
  std::vector<Bezier> rest_, tubes_;
  std::unique_ptr<TubeDetector> detector_;
  std::vector<RestPair> restPairs_;  // sorted
  std::vector<Place> places_;
};

}  // namespace vasa
