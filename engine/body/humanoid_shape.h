#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "math/types.h"

namespace vasa {

/// What the joints of a human skeleton are, in the words of body/humanoid.h, judged by its shape alone: the
/// two joints at which equal pairs of limbs leave a line are where arms and legs hang (equal as a whole, or
/// joint by joint up to what one hand holds); of each limb those three joints are shoulder, elbow and wrist
/// (hip, knee and ankle) whose two straight bones look most like a person's, by their lengths against one
/// another and against the leg, so that joints between them may twist them; a limb may end at a tip in
/// place of wrist or ankle. Trunk, neck and head but for the hips are left to body/trunk.h. Which pair is
/// the legs is told by the feet, which point forward, or by the root, which is nearer to them; which side
/// is left by where the feet point.
/// @param parents  of each joint, before it; JointId::kNone at a root
/// @param places, tips  in any pose that is not folded; tips: of a joint's end where it has one, else its
/// place
/// @return one a joint, empty where unknown; all empty where the shape is none of a person. O(joints²)
std::vector<std::string_view> humanoidShape(std::span<const std::uint32_t> parents,
                                            std::span<const vec3> places, std::span<const vec3> tips);

}  // namespace vasa
