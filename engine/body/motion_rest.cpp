#include "body/motion_rest.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::uint32_t kFramesAsked = 64;
constexpr float kUpright = 0.5f;  // least cosine between the trunk and +Y for +Y to be up
constexpr float kSteady = 0.8f;   // length of the mean of unit vectors that say the same
constexpr float kStandingTrunk = 0.77f, kStandingLeg = 0.71f;  // cosines of 40 and 45 degrees
constexpr const char* kSides[] = {"left", "right"};

quat orIdentity(const Motion& motion, std::uint32_t frame, std::size_t joint) {
  return frame == MotionPose::kZero ? quat(1, 0, 0, 0) : motion.rotation(frame, joint);
}

class RestStance {
 public:
  explicit RestStance(std::span<const std::string_view> parts) : parts_(parts) {
    hips_ = of("hips");
    for (const char* part : {"neck", "head", "upperChest", "chest"})
      if (top_ == kNone) top_ = of(part);
  }

  std::uint32_t of(std::string_view part) const {
    const auto found = std::ranges::find(parts_, part);
    return found == parts_.end() ? kNone : std::uint32_t(found - parts_.begin());
  }
  std::uint32_t hips() const { return hips_; }

  // From the feet, or what is known of the legs, to the top of the trunk.
  vec3 up(const MotionPose& pose) const {
    vec3 low(0);
    int count = 0;
    for (const std::string side : kSides)
      for (const char* part : {"Foot", "LowerLeg", "UpperLeg"})
        if (const std::uint32_t j = of(side + part); j != kNone) {
          low += pose.places[j], ++count;
          break;
        }
    if (count == 0 && hips_ != kNone) low = pose.places[hips_], count = 1;
    if (top_ == kNone || count == 0) return vec3(0);
    const vec3 way = pose.places[top_] - low / float(count);
    const float length = glm::length(way);
    return length > 0 ? way / length : vec3(0);
  }

  // Cosines of the trunk with +Y and of each bone of the legs with -Y.
  struct Uprightness {
    float trunk = 0, worstLeg = 1, sum = 0;
  };
  Uprightness uprightness(const MotionPose& pose) const {
    Uprightness result;
    const auto along = [&](std::uint32_t a, std::uint32_t b) {
      const vec3 way = pose.places[b] - pose.places[a];
      const float length = glm::length(way);
      return length > 0 ? way.y / length : 0.0f;
    };
    if (hips_ != kNone && top_ != kNone) result.trunk = along(hips_, top_);
    result.sum = result.trunk;
    for (const std::string side : kSides)
      for (const auto& [from, to] : {std::pair("UpperLeg", "LowerLeg"), std::pair("LowerLeg", "Foot")}) {
        const std::uint32_t a = of(side + from), b = of(side + to);
        if (a == kNone || b == kNone) continue;
        const float down = -along(a, b);
        result.worstLeg = std::min(result.worstLeg, down);
        result.sum += down;
      }
    return result;
  }

  float legLength(const MotionPose& pose) const {
    float longest = 0;
    for (const std::string side : kSides) {
      const std::uint32_t a = of(side + "UpperLeg"), b = of(side + "LowerLeg"), c = of(side + "Foot");
      if (a == kNone || b == kNone || c == kNone) continue;
      longest = std::max(longest, glm::distance(pose.places[a], pose.places[b]) +
                                      glm::distance(pose.places[b], pose.places[c]));
    }
    return longest;
  }

 private:
  std::span<const std::string_view> parts_;
  std::uint32_t hips_ = kNone, top_ = kNone;
};

}  // namespace

MotionPose motionPose(const Motion& motion, std::uint32_t frame) {
  MotionPose pose;
  for (std::size_t i = 0; i < motion.joints.size(); ++i) {
    const Motion::Joint& joint = motion.joints[i];
    const quat above = joint.parent.valid() ? pose.world[joint.parent.value] : quat(1, 0, 0, 0);
    const vec3 from = joint.parent.valid() ? pose.places[joint.parent.value] : vec3(0);
    const vec3 offset = frame == MotionPose::kZero ? joint.offset : motion.translation(frame, i);
    pose.world.push_back(glm::normalize(above * orIdentity(motion, frame, i)));
    pose.places.push_back(from + above * offset);
    pose.tips.push_back(pose.places.back() + pose.world.back() * joint.endOffset);
  }
  return pose;
}

std::vector<std::uint32_t> sampledFrames(const Motion& motion, std::uint32_t most) {
  std::vector<std::uint32_t> frames;
  const std::uint32_t count = std::min(most, motion.frameCount);
  for (std::uint32_t k = 0; k < count; ++k)
    frames.push_back(std::uint32_t(std::uint64_t(k) * motion.frameCount / count));
  return frames;
}

vec3 upOf(const Motion& motion, std::span<const std::string_view> parts) {
  const vec3 house(0, 1, 0);
  const RestStance stance(parts);
  if (stance.hips() == kNone) return house;
  vec3 mean(0), hips(0);
  float away = 0;
  const auto frames = sampledFrames(motion, kFramesAsked);
  for (const std::uint32_t frame : frames) {
    const MotionPose pose = motionPose(motion, frame);
    mean += stance.up(pose) / float(frames.size());
    hips += pose.places[stance.hips()] / float(frames.size());
    away = std::max(away, glm::length(pose.places[stance.hips()]));
  }
  const float steady = glm::length(mean);
  if (steady < kSteady || mean.y >= kUpright * steady) return house;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(mean[i]) > std::abs(mean[axis])) axis = i;
  vec3 up(0);
  up[axis] = mean[axis] > 0 ? 1.0f : -1.0f;
  const float leg = stance.legLength(motionPose(motion, MotionPose::kZero)), high = glm::dot(hips, up);
  const bool stands = high > 0.5f * leg && high < 1.6f * leg, inPlace = away < 0.2f * leg;
  return stands || inPlace ? up : house;
}

Motion withUp(const Motion& motion, vec3 up) {
  if (up == vec3(0, 1, 0)) return motion;
  const vec3 side = up == vec3(0, -1, 0) ? vec3(1, 0, 0) : glm::cross(vec3(0, 1, 0), up);
  // Rows: what becomes x, y, z. A quarter turn about the axis that is neither, a half turn about x where up
  // was down.
  const vec3 back = glm::cross(side, up);
  mat3 turn = glm::transpose(mat3(side, up, back));
  if (std::abs(up.z) > 0.5f)
    turn = up.z > 0 ? mat3(vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, 1, 0))
                    : mat3(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
  const quat q = glm::normalize(glm::quat_cast(turn));
  Motion turned = motion;
  for (Motion::Joint& joint : turned.joints)
    joint.offset = turn * joint.offset, joint.endOffset = turn * joint.endOffset;
  for (quat& rotation : turned.rotations) rotation = glm::normalize(q * rotation * glm::conjugate(q));
  for (vec3& place : turned.translations) place = turn * place;
  return turned;
}

std::uint32_t standingPose(const Motion& motion, std::span<const std::string_view> parts) {
  const RestStance stance(parts);
  if (stance.hips() == kNone) return MotionPose::kZero;
  const auto zero = stance.uprightness(motionPose(motion, MotionPose::kZero));
  if (zero.trunk >= kStandingTrunk && zero.worstLeg >= kStandingLeg) return MotionPose::kZero;
  std::uint32_t best = MotionPose::kZero;
  float most = zero.sum;
  for (const std::uint32_t frame : sampledFrames(motion, kFramesAsked))
    if (const float sum = stance.uprightness(motionPose(motion, frame)).sum; sum > most + 0.02f)
      most = sum, best = frame;
  return best;
}

double metresAUnit(const Motion& motion, std::span<const std::string_view> parts) {
  const double leg = double(RestStance(parts).legLength(motionPose(motion, MotionPose::kZero)));
  for (const double unit : {1.0, 0.01, 0.0254, 0.0564, 0.001})
    if (leg * unit > 0.45 && leg * unit < 1.15) return unit;
  return 0;
}

}  // namespace vasa
