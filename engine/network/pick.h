#pragma once
#include <functional>
#include <optional>

#include "network/network.h"

namespace vasa {

struct Ray {
  vec3 origin{0};
  vec3 direction{0, 0, -1};  ///< unit
  float from = 0;            ///< [m] along it: what is nearer does not count
};

/// A place of a vessel that a ray meets.
struct Picked {
  VesselId vessel;
  float parameter = 0;  ///< u in [0, spans]
  float distance = 0;   ///< [m] along the ray, to where the tube is met
};

/// The first vessel that a ray meets. Tubes are looked at as chains of round cones, eight a span.
/// @param points  as Network::points()
/// @param shown   which vessels count; empty: all
/// @param slack   [m] for a metre of distance: a thinner vessel is met as if it were so thick (a pointer's
/// reach) O(spans).
std::optional<Picked> pick(const Network& network, std::span<const vec4> points, const Ray& ray,
                           const std::function<bool(VesselId)>& shown = {}, float slack = 0);

}  // namespace vasa
