#pragma once
#include <span>
#include <vector>

#include "avoid/interference.h"
#include "avoid/motion_space.h"

namespace vasa {

/// The least change of a network at rest that parts its tubes, found step by step.
///
/// Motion: the least zᵀ W z (avoid/motion_space.h: smooth along a vessel, ends on their nodes, wide vessels
/// move least) for which every two tubes keep the clearance between them, that linearised at their
/// sidePlaces(). By dual ascent whose forces last from step to step: what was pushed aside and need not be
/// swings back, so that the vessels end where the least motion leads and not where all the pushes add up to.
/// Thinning: both radii give way by the same factor, tapered along the vessel; ends that share a ring get the
/// same. The network must outlive it; one object serves one caller.
class RestParting {
 public:
  /// @param clearance  [m] between the walls of two tubes
  RestParting(const Network& network, float clearance);

  /// [m] Places where tubes come so near one another must be told to move(), or their forces are forgotten.
  float watched() const;
  /// One step. @param places in points(), sorted by pair  @param layout  of the network in points() or nearly
  /// so  @param tubes  in which the places were found
  void move(std::span<const Interference::Place> places, const NetworkTubes& layout,
            std::span<const Bezier> tubes);
  /// Radii give way by a part of what is lacking at each place, down to kLeastRadiusShare of what they were
  /// and by no more than kMostThinning.
  void thin(std::span<const Interference::Place> places, const NetworkTubes& layout,
            std::span<const Bezier> tubes);

  /// The network as it is now; as Network::points().
  std::span<const vec4> points() const { return points_; }

 private:
  struct Key {
    TubePair tubes;
    std::uint32_t place;  // of their sidePlaces()
    auto operator<=>(const Key&) const = default;
  };
  struct Push {
    MotionSpace::Row row;
    Key key;
    vec3 normal;
    float distance;  // [m] that the two must be apart along the normal, from where z is 0
    float force = 0;
  };
  struct Force {
    Key key;
    float size;
  };
  void addPushes(const Contact& contact, const NetworkTubes& layout, std::span<const Bezier> tubes,
                 std::vector<Push>& pushes);
  float forceOf(const Key& key) const;
  void ascend(std::span<Push> pushes, std::span<vec3> z) const;
  void taper(std::span<float> shares) const;
  void shape();

  const Network* network_;
  float clearance_;
  MotionSpace space_;
  MotionSpace::Rows rows_;
  std::vector<MotionSpace::Term> terms_;
  std::vector<vec3> z_;        // the motion so far
  std::vector<float> shares_;  // of the radius at rest, one a point
  std::vector<Force> forces_;  // of the last step, sorted
  std::vector<vec4> points_;
};

/// The share of a radius that is left at least: scanned vessels were parted with it, and no more than 1 % of
/// the pairs is left. Below a radius of 1.3 mm it counts before kMostThinning.
constexpr float kLeastRadiusShare = 0.25f;
/// [m] how well a source tells a radius: what its surface may be missed by
constexpr float kMostThinning = 0.001f;

}  // namespace vasa
