#pragma once
#include <span>

#include "network/network.h"
#include "realism/vessel_path.h"

namespace vasa {

/// How a stretch of vessels lies in a pose, and what of that the pose made. Bends are looked at over 5 mm,
/// what is shortest or most twisted over 10 mm: about what the published figures were measured with.
struct PathMeasures {
  float length = 0;       ///< [m]
  float strain = 0;       ///< length by that at rest, less 1
  float leastStrain = 0;  ///< of the 10 mm that shortened most
  float chordByArc = 1;
  float meanCurvature = 0;    ///< [1/m] along it
  float leastBendRadius = 0;  ///< [m]
  float twist = 0;  ///< [radians] by which its end turned about the course against its beginning, since rest
  float greatestTwist = 0;  ///< [radians a metre] over the 10 mm that twisted most
  float meanRadius = 0;     ///< [m] of the lumen
};

/// @param points     as Network::points(), in the pose
/// @param rotations  how each point's surroundings turned since rest (Deformer::rotations); empty: no twist
/// is measured
PathMeasures measurePath(const Network& network, const VesselPath& path, std::span<const vec4> points,
                         std::span<const quat> rotations);

}  // namespace vasa
