#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "body/motion.h"

namespace vasa {

/// Frames that go on from the ones before as no person does: where a tracker lost its person, or another pose
/// was put in front. The hips are faster than anybody runs, or a limb turns by over a right angle from one
/// frame to the next. None where hips or legs are not known. O(frames * joints)
/// @param parts  what each joint is (body/humanoid.h)
std::vector<std::uint32_t> leapsOf(const Motion& motion, std::span<const std::string_view> parts);

}  // namespace vasa
