#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

/// What joints are by the words in their names, where no known convention has them: side and part are looked
/// for in any order, case and with any marks, numbers and prefixes ("Bip01 L UpperArm", "lShldr", "L_Knee",
/// "DEF-thigh.L"). A word that means two things is read by what else there is: a Shoulder is the upper arm
/// where nothing else is. Joints that only twist, aim or end are passed over. @return one a joint
/// (body/humanoid.h), empty where unknown
std::vector<std::string_view> humanoidWords(std::span<const std::string> joints);

}  // namespace vasa
