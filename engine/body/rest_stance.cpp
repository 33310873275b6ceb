#include "body/rest_stance.h"

#include <algorithm>

#include "body/humanoid.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kStandingTrunk = 0.77f, kStandingLeg = 0.71f;  // cosines of 40 and 45 degrees

}  // namespace

RestStance::RestStance(std::span<const std::string_view> parts)
    : parts_(parts), hips_(of("hips")), top_(kNone) {
  for (const char* part : {"neck", "head", "upperChest", "chest"})
    if (top_ == kNone) top_ = of(part);
}

std::uint32_t RestStance::of(std::string_view part) const { return partNamed(parts_, part); }

std::optional<vec3> RestStance::legEnd(const MotionPose& pose, const std::string& side) const {
  if (const std::uint32_t foot = of(side + "Foot"); foot != kNone) return pose.places[foot];
  if (const std::uint32_t knee = of(side + "LowerLeg"); knee != kNone) return pose.tips[knee];
  if (const std::uint32_t hip = of(side + "UpperLeg"); hip != kNone) return pose.places[hip];
  return std::nullopt;
}

vec3 RestStance::up(const MotionPose& pose) const {
  vec3 low(0);
  int count = 0;
  for (const std::string side : kBothSides)
    if (const auto end = legEnd(pose, side)) low += *end, ++count;
  if (count == 0 && hips_ != kNone) low = pose.places[hips_], count = 1;
  if (top_ == kNone || count == 0) return vec3(0);
  const vec3 way = pose.places[top_] - low / float(count);
  const float length = glm::length(way);
  return length > 0 ? way / length : vec3(0);
}

float RestStance::lowFoot(const MotionPose& pose, vec3 axis) const {
  float low = glm::dot(pose.places[hips_], axis);
  for (const std::string side : kBothSides)
    if (const auto end = legEnd(pose, side)) low = std::min(low, glm::dot(*end, axis));
  return low;
}

RestStance::StandingFoot RestStance::standingFoot(const MotionPose& pose) const {
  StandingFoot foot;
  const vec3 way = up(pose), hips = pose.places[hips_];
  float low = 0;
  for (int side = 0; side < 2; ++side) {
    const auto end = legEnd(pose, kBothSides[side]);
    if (!end) continue;
    const float height = glm::dot(*end - hips, way);
    if (height < low) low = height, foot = {side, *end - hips};
  }
  return foot;
}

std::optional<RestStance::StandingStep> RestStance::standingStep(const MotionPose& before,
                                                                 const MotionPose& after) const {
  const StandingFoot from = standingFoot(before), to = standingFoot(after);
  if (from.side < 0 || from.side != to.side) return std::nullopt;
  return StandingStep{after.places[hips_] - before.places[hips_], to.fromHips - from.fromHips};
}

RestStance::Uprightness RestStance::uprightness(const MotionPose& pose, vec3 axis) const {
  Uprightness result;
  const auto along = [&](vec3 a, vec3 b) {
    const float length = glm::distance(a, b);
    return length > 0 ? glm::dot(b - a, axis) / length : 0.0f;
  };
  if (hips_ != kNone && top_ != kNone) result.trunk = along(pose.places[hips_], pose.places[top_]);
  result.sum = result.trunk;
  const auto add = [&](vec3 from, vec3 to) {
    const float down = -along(from, to);
    result.worstLeg = std::min(result.worstLeg, down);
    result.sum += down;
  };
  for (const std::string side : kBothSides) {
    const std::uint32_t hip = of(side + "UpperLeg"), knee = of(side + "LowerLeg");
    if (knee == kNone) continue;
    if (hip != kNone) add(pose.places[hip], pose.places[knee]);
    if (const vec3 end = *legEnd(pose, side); end != pose.places[knee]) add(pose.places[knee], end);
  }
  return result;
}

bool RestStance::stands(const MotionPose& pose, vec3 axis) const {
  const Uprightness own = uprightness(pose, axis);
  return own.trunk >= kStandingTrunk && own.worstLeg >= kStandingLeg;
}

float RestStance::legLength(const MotionPose& pose) const {
  float longest = 0;
  for (const std::string side : kBothSides) {
    const std::uint32_t hip = of(side + "UpperLeg"), knee = of(side + "LowerLeg");
    if (hip == kNone || knee == kNone) continue;
    const float shin = glm::distance(pose.places[knee], *legEnd(pose, side));
    if (shin > 0) longest = std::max(longest, glm::distance(pose.places[hip], pose.places[knee]) + shin);
  }
  return longest;
}

}  // namespace vasa
