#pragma once
#include <span>
#include <vector>

#include "avoid/motion_space.h"
#include "avoid/nearby_steps.h"

namespace vasa {

/// How far, and how fast, vessels may be moved aside: from one step to the next no point by more than what is
/// about it moves, or by a slow pace among what stands still. So nothing jumps, whatever asks for it.
class Pace {
 public:
  /// Both must outlive this.
  Pace(const Network& network, MotionSpace& space);

  /// A step begins. @param before, now  as Network::points(), posed, without any correction; must stay in
  /// place until the last keep() of the step
  void begin(std::span<const vec4> before, std::span<const vec4> now, float seconds);

  /// Draws a correction nearer to the last step's where it would be too far from it.
  /// @param last, motions  as MotionSpace's variables  @param free  one a point: 1 where it keeps no pace; or
  /// none. O(points that move)
  void keep(std::span<const vec3> last, std::span<vec3> motions, std::span<const char> free);

  /// [m] by which anything may be moved aside in this step, whatever is about it.
  float slow() const { return slow_; }

  /// Whether a point is a vessel's first or last.
  bool isEnd(std::size_t point) const { return isEnd_[point]; }

 private:
  vec3 onCurve(std::span<const vec4> points, std::size_t point) const;

  MotionSpace* space_;
  std::vector<char> isEnd_;
  std::vector<vec3> none_;  // no correction
  std::span<const vec4> before_, now_;
  float slow_ = 0;  // [m] in this step, among what stands still
  NearbySteps nearby_;
  bool nearbyIsSet_ = false;  // for this step
};

/// [m] around a point that counts: less than what eyes, and CorrectionSteps, look at together.
constexpr float kNearPace = 0.045f;

}  // namespace vasa
