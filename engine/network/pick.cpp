#include "network/pick.h"

#include <algorithm>
#include <cmath>

#include "math/segment_distance.h"

namespace vasa {
namespace {

constexpr int kPieces = 8;         // of a span
constexpr float kFarthest = 1e3f;  // [m] of a ray

// Distance along the ray at which it enters the box, or a negative number.
bool meets(const Ray& ray, const Aabb& box, float farthest) {
  float enter = ray.from, leave = farthest;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / ray.direction[axis];
    float near = (box.low[axis] - ray.origin[axis]) * inverse,
          far = (box.high[axis] - ray.origin[axis]) * inverse;
    if (near > far) std::swap(near, far);
    if (std::isnan(near) || std::isnan(far)) continue;  // the ray runs in one of the box's faces
    enter = std::max(enter, near);
    leave = std::min(leave, far);
  }
  return enter <= leave;
}

struct Search {
  const Ray& ray;
  float slack;
  std::optional<Picked> best;

  float nearest() const { return best ? best->distance : kFarthest; }

  void look(const Bezier& tube, VesselId vessel, std::uint32_t span) {
    Aabb box = tube.bounds();
    const float reach = slack * (glm::distance(box.centre(), ray.origin) + 0.5f * glm::length(box.extent()));
    box.low -= reach;
    box.high += reach;
    if (!meets(ray, box, nearest())) return;
    vec4 a = tube.at(0);
    for (int k = 0; k < kPieces; ++k) {
      const vec4 b = tube.at(float(k + 1) / kPieces);
      lookAtPiece(a, b, vessel, float(span) + float(k) / kPieces);
      a = b;
    }
  }

  void lookAtPiece(vec4 a, vec4 b, VesselId vessel, float parameter) {
    const vec3 start = ray.origin + ray.from * ray.direction, end = ray.origin + kFarthest * ray.direction;
    const auto closest = closestOnSegments(dvec3(start), dvec3(end), dvec3(vec3(a)), dvec3(vec3(b)));
    const float along = ray.from + float(closest.s) * (kFarthest - ray.from);
    const float radius = glm::mix(a.w, b.w, float(closest.t));
    const float gap = float(closest.distance);
    if (gap > std::max(radius, slack * along)) return;
    // Where the ray goes by within the tube, it entered so much earlier.
    const float distance = std::max(ray.from, along - std::sqrt(std::max(radius * radius - gap * gap, 0.0f)));
    if (distance < nearest()) best = Picked{vessel, parameter + float(closest.t) / kPieces, distance};
  }
};

}  // namespace

std::optional<Picked> pick(const Network& network, std::span<const vec4> points, const Ray& ray,
                           const std::function<bool(VesselId)>& shown, float slack) {
  Search search{ray, slack, std::nullopt};
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    if (shown && !shown(VesselId{v})) continue;
    const auto own = Network::pointsOf(vessel, points);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      search.look(bezierOfSpan(own, span), VesselId{v}, span);
  }
  return search.best;
}

}  // namespace vasa
