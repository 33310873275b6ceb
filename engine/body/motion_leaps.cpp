#include "body/motion_leaps.h"

#include <string>
#include <utility>

#include "body/humanoid.h"
#include "body/rest_stance.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kFastest = 16;  // [legs/s]: who runs fastest makes 12.4 m a second, 14.5 of their legs
// Below this a limb may well turn by a right angle between two frames. The fastest, of who throws or kicks,
// turn by some 70 degrees in a thirtieth of a second.
constexpr float kFewestFrames = 24;  // a second

}  // namespace

std::vector<std::uint32_t> leapsOf(const Motion& motion, std::span<const std::string_view> parts) {
  const RestStance stance(parts);
  if (stance.hips() == kNone || motion.frameCount == 0) return {};
  const float leg = stance.legLength(motionPose(motion, 0));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bones;
  for (const std::string side : kBothSides)
    for (const auto& [from, to] : {std::pair("UpperArm", "LowerArm"), std::pair("LowerArm", "Hand"),
                                   std::pair("UpperLeg", "LowerLeg"), std::pair("LowerLeg", "Foot")})
      if (const std::uint32_t a = partNamed(parts, side + from), b = partNamed(parts, side + to);
          a != kNone && b != kNone)
        bones.emplace_back(a, b);
  const float farthest = kFastest * leg / motion.framesPerSecond;
  std::vector<std::uint32_t> leaps;
  MotionPose before = motionPose(motion, 0);
  for (std::uint32_t frame = 1; leg > 0 && frame < motion.frameCount; ++frame) {
    MotionPose pose = motionPose(motion, frame);
    bool isLeap = glm::distance(pose.places[stance.hips()], before.places[stance.hips()]) > farthest;
    for (const auto& [from, to] : bones)
      isLeap |= motion.framesPerSecond >= kFewestFrames &&
                glm::dot(pose.places[to] - pose.places[from], before.places[to] - before.places[from]) < 0;
    if (isLeap) leaps.push_back(frame);
    before = std::move(pose);
  }
  return leaps;
}

}  // namespace vasa
