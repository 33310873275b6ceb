#pragma once
#include <span>

#include "body/clip.h"
#include "body/joint_motion.h"

namespace vasa::viewer {

/// A clip with joints turned beside what it does, as one clip: a key a frame for every joint.
/// @param clip  null: the rest pose, as a clip of one frame
Clip turnedClip(const Skeleton& skeleton, const Clip* clip, std::span<const JointTurn> turns);

}  // namespace vasa::viewer
