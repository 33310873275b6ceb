#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "body/motion.h"

namespace vasa {

/// A motion's joints in one pose, in space.
struct MotionPose {
  std::vector<quat> world;
  std::vector<vec3> places, tips;  ///< tips: of a tip's end where the file has one, else the joint's place

  static constexpr std::uint32_t kZero = 0xffffffffu;  ///< the pose with all rotations zero
};
/// @param frame  or MotionPose::kZero. O(joints)
MotionPose motionPose(const Motion& motion, std::uint32_t frame);

/// Some of a motion's frames, evenly, the first one among them.
std::vector<std::uint32_t> sampledFrames(const Motion& motion, std::uint32_t most);
/// Steps of about so many seconds that are spread over a motion, as the first and the last frame of each;
/// none of a motion that is shorter.
std::vector<std::array<std::uint32_t, 2>> sampledSteps(const Motion& motion, float seconds,
                                                       std::uint32_t most);

/// Which way is up in a motion: the axis along which its zero pose stands. Another one, along which the
/// person is stretched out in the frames, only where the feet stay at one height along it and two of three
/// hold: the hips are as high along it as legs are long, they are not always as those of somebody on a floor
/// along the zero pose's (who lies or crawls), it is +Y. Where the zero pose does not stand, the axis of the
/// frames, if feet and hips are so or the hips never leave the origin; else +Y. Others' files have +Z up,
/// also such whose zero pose stands along +Y.
/// @param parts  what each joint is (body/humanoid.h)
vec3 upOf(const Motion& motion, std::span<const std::string_view> parts);

/// The turn that makes this axis +Y. @param up  one of the axes' directions
mat3 uprightTurn(vec3 up);
/// The same motion told with this axis as +Y, by that turn.
Motion withUp(const Motion& motion, vec3 up);

/// The pose to compare a body's rest pose with: all rotations zero, where that is a person who stands (arms
/// may hang, be stretched out or anything between); else, as in files whose zero pose has all bones along
/// one axis, the frame of the motion that stands most upright, or where none does lies most straight.
/// @return its frame, or MotionPose::kZero
std::uint32_t standingPose(const Motion& motion, std::span<const std::string_view> parts);

}  // namespace vasa
