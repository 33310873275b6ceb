#pragma once
#include <optional>

#include "body/body.h"
#include "network/network.h"
#include "realism/vessel_path.h"

namespace vasa {

/// How far a vessel's wall is from the nearest bone: where the path passes a level of a limb that moves with
/// its joint, or where it is nearest.
/// @param joint   the limb's joint
/// @param level   [m] above where the joint's own bone begins below it, at rest (body upright)
/// @param points  as Network::points(), in the pose
/// @return [m] from the surface of the wall to that of the bone
/// O(stations looked at · triangles of the bones + their vertices)
float boneGap(const Body& body, const Pose& pose, JointId joint, std::optional<float> level,
              const Network& network, const VesselPath& path, std::span<const vec4> points);

}  // namespace vasa
