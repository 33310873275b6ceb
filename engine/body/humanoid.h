#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

/// What a joint is in a human body, in the words of the VRM humanoid ("hips", "leftUpperArm", "rightToes" ...),
/// judged by its name. Known families: CMU's mocap files, Mixamo, MakeHuman's game and default rigs, VRM,
/// VRoid and Biovision's own (Collar, Shoulder, Elbow, Wrist; Hip, Knee, Ankle). The family is the one that knows most of the names; letters' case, prefixes up to a colon and marks
/// between letters do not matter.
struct HumanoidNames {
  std::string_view family;           ///< "cmu", "mixamo" ...; empty where no family fits
  std::vector<std::string_view> of;  ///< one a joint; empty where unknown
};
HumanoidNames humanoidNames(const std::vector<std::string>& joints);

/// A name without case, prefix and marks, as comparisons see it.
std::string plainName(std::string_view name);

/// Which joint of a body follows which joint of a motion.
using JointMap = std::map<std::string, std::string>;  // motion's joint -> body's joint; empty: none

}  // namespace vasa
