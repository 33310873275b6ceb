#pragma once
#include <span>
#include <vector>

#include "math/types.h"
#include "network/route.h"

namespace vasa {

/// A place along a vessel and what is measured there.
struct ProfileStation {
  float along = 0;      ///< [m] of arc from the vessel's start
  float parameter = 0;  ///< u in [0, spans]
  vec3 centre{0};       ///< [m]
  vec3 tangent{0};      ///< unit
  float radius = 0;     ///< [m]
  float curvature = 0;  ///< [1/m] of the centre line

  float area() const {
    return kPi * radius * radius;
  }  ///< [m²] of the lumen, at right angles to the centre line
};

/// Stations along one vessel at equal distances, both ends included.
/// @param points  de Boor points of one vessel
/// @param step    [m] > 0: they are no farther apart
/// O(spans + stations)
std::vector<ProfileStation> stationsOf(std::span<const vec4> points, float step);

/// The same along a way through the network, `along` from where it begins; where it goes over from one vessel
/// to another there is a station on each.
/// @param points  as Network::points(), in any pose
std::vector<ProfileStation> stationsAlong(const Network& network, std::span<const vec4> points,
                                          const Route& route, float step);

}  // namespace vasa
