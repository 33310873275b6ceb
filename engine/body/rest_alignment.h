#pragma once
#include <span>
#include <vector>

#include "body/rig.h"
#include "core/ids.h"

namespace vasa {

/// The turn of each of a body's joints that brings its rest pose to the pose in which a motion stands:
/// hands, limbs and trunk point as the motion's do there, and elbows bend about the axis that they are bent
/// about in it. What follows nothing goes with the joint above it.
/// @param motion    upright
/// @param standing  one of its frames, or MotionPose::kZero; `from` is placed in it
/// @param turns     of the motion's joints there (MotionPose::world)
/// @param source    the motion's joint that each of the body's follows; kNone where there is none
/// O(frames + joints²)
std::vector<quat> alignRest(const Motion& motion, std::uint32_t standing, std::span<const quat> turns,
                            const Rig& from, const Rig& to, std::span<const std::uint32_t> source);

}  // namespace vasa
