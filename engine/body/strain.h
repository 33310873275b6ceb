#pragma once
#include <span>
#include <vector>

#include "network/network.h"

namespace vasa {

/// How unevenly a vessel's length changed between two shapes of a network.
struct VesselStrain {
  VesselId vessel;
  float least = 1, most = 1;  ///< lengths of pieces after by before, by the factor
  vec3 place{0};              ///< [m] after, of the piece that changed most
};

/// Looks at each vessel in pieces of kStrainPiece (shorter vessels as a whole), those that changed most
/// first.
/// @param before, after  as Network::points() [m]
/// @param factor  by which lengths change where nothing is strained, > 0
/// O(points)
std::vector<VesselStrain> measureStrain(const Network& network, std::span<const vec4> before,
                                        std::span<const vec4> after, float factor);
constexpr float kStrainPiece = 0.02f;  ///< [m] before

}  // namespace vasa
