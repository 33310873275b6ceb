#pragma once
#include <string>
#include <string_view>

#include "math/types.h"

namespace vasa::viewer {

/// What people call the joint that moves a part of the body: "left elbow" for "leftLowerArm"
/// (body/humanoid.h); empty for a part without such a name.
std::string peoplesName(std::string_view part);

/// How a joint moves about one of its axes (JointMotion: 0 bend, 1 spread, 2 twist), in anatomists' words.
const char* wordForAxis(std::string_view part, int axis);

/// +1 or -1 for each axis: which way of JointMotion's is the one that the word means. Flexion takes a knee
/// backwards and everything else forwards, abduction leads away from the midline (in the middle: to the
/// left), rotation inwards (in the middle: to the left), as in data/realism/ranges.csv.
vec3 sensesOf(std::string_view part);

}  // namespace vasa::viewer
