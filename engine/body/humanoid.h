#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

/// What a joint is in a human body, in the words of the VRM humanoid ("hips", "leftUpperArm", "rightToes"
/// ...), judged by its name. Known families: CMU's mocap files, Mixamo, MakeHuman's game and default rigs,
/// VRM, VRoid and Biovision's own (Collar, Shoulder, Elbow, Wrist; Hip, Knee, Ankle). The family is the one
/// that knows most of the names; letters' case, prefixes up to a colon and marks between letters do not
/// matter. Where words alone tell more (body/humanoid_words.h) the family is "words".
struct HumanoidNames {
  std::string_view family;           ///< "cmu", "mixamo" ...; empty where no family fits
  std::vector<std::string_view> of;  ///< one a joint; empty where unknown
};
HumanoidNames humanoidNames(const std::vector<std::string>& joints);

/// The joint that is a part; kNone where there is none. @param parts  one a joint
std::uint32_t partNamed(std::span<const std::string_view> parts, std::string_view part);

/// The same word, for ever; empty where there is no such part.
std::string_view humanoidPart(std::string_view name);

/// Names a spine's joints, from low to high: the first, the middle and the last one are spine, chest and
/// upper chest; of two the last is the chest.
void nameSpine(std::span<const std::uint32_t> joints, std::span<std::string_view> parts);

/// How many of the fourteen parts that make a person move are there: hips, neck or head, and of each side
/// upper and lower arm, hand, upper and lower leg, foot.
int humanoidKeys(std::span<const std::string_view> of);
constexpr int kHumanoidKeys = 14;

/// A name without case, prefix and marks, as comparisons see it.
std::string plainName(std::string_view name);

/// Which joint of a body follows which joint of a motion.
using JointMap = std::map<std::string, std::string>;  // motion's joint -> body's joint; empty: none

}  // namespace vasa
