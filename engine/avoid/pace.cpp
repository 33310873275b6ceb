#include "avoid/pace.h"

#include <utility>

namespace vasa {
namespace {

// [m/s] at which a vessel may be moved aside among others that stand still
constexpr float kSlow = 0.04f;
// ... and of what moves near by: it is looked at point by point, and may be as much slower between them
constexpr float kPaceShare = 0.98f;
// [m] that anything is held aside, what a second at the slow pace comes to: what is caught on another limb is
// let go there
constexpr float kFarthestAside = kSlow;

}  // namespace

Pace::Pace(const Network& network, MotionSpace& space)
    : space_(&space),
      isEnd_(network.points().size(), false),
      none_(space.variableCount(), vec3(0)),
      nearby_(kNearPace) {
  for (const Vessel& vessel : network.vessels())
    isEnd_[vessel.firstPoint] = isEnd_[vessel.firstPoint + vessel.pointCount - 1] = true;
}

void Pace::begin(std::span<const vec4> before, std::span<const vec4> now, float seconds) {
  before_ = before;
  now_ = now;
  slow_ = kSlow * seconds;
  nearbyIsSet_ = false;
}

// The curve's own place next to a de Boor point, which swings about more than that.
vec3 Pace::onCurve(std::span<const vec4> points, std::size_t point) const {
  if (isEnd_[point]) return vec3(points[point]);
  return (vec3(points[point - 1]) + 4.0f * vec3(points[point]) + vec3(points[point + 1])) / 6.0f;
}

void Pace::keep(std::span<const vec3> last, std::span<vec3> motions, std::span<const char> free) {
  if (!std::exchange(nearbyIsSet_, true))
    nearby_.set(slow_, now_.size(), [&](std::size_t k) {
      const vec3 place = onCurve(now_, k);
      return std::pair(place, glm::distance(place, onCurve(before_, k)));
    });
  space_->keepNear(last, motions, slow_, [&](std::uint32_t point, float distance) {
    if (!free.empty() && free[point]) return distance;
    return kPaceShare * nearby_.longest(vec3(now_[point]), distance / kPaceShare);
  });
  space_->keepNear(none_, motions, kFarthestAside, [](std::uint32_t, float) { return kFarthestAside; });
}

}  // namespace vasa
