#include "body/motion_rest.h"

#include <algorithm>
#include <cmath>

#include "body/rest_stance.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::uint32_t kFramesAsked = 64;
constexpr float kUpright = 0.5f;  // least cosine between the trunk and +Y for +Y to be up
constexpr float kSteady = 0.8f;   // length of the mean of unit vectors that say the same
// Shares of a leg. Hips are as high above a floor as legs are long, whether they squat or tiptoe; not even
// those who lie have theirs nearer to it than half of a trunk's thickness; the lower foot stays on it but
// for steps and small leaps.
constexpr float kLowestHips = 0.5f, kHighestHips = 1.6f, kLyingHips = 0.05f, kFootLift = 0.15f;

quat orIdentity(const Motion& motion, std::uint32_t frame, std::size_t joint) {
  return frame == MotionPose::kZero ? quat(1, 0, 0, 0) : motion.rotation(frame, joint);
}

// The axis that a direction is nearest to.
vec3 axisOf(vec3 way) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(way[i]) > std::abs(way[axis])) axis = i;
  vec3 nearest(0);
  nearest[axis] = way[axis] > 0 ? 1.0f : -1.0f;
  return nearest;
}

// What some of a motion's frames say of where its floor is.
class FramesStance {
 public:
  FramesStance(const Motion& motion, const RestStance& stance) : stance_(stance) {
    for (const std::uint32_t frame : sampledFrames(motion, kFramesAsked))
      poses_.push_back(motionPose(motion, frame));
    leg_ = stance.legLength(poses_.front());
  }

  // Along which the person is stretched out in the mean, which may be lying; +Y where that varies much.
  vec3 up() const {
    vec3 mean(0);
    for (const MotionPose& pose : poses_) mean += stance_.up(pose) / float(poses_.size());
    const float steady = glm::length(mean);
    return steady < kSteady || mean.y >= kUpright * steady ? vec3(0, 1, 0) : axisOf(mean);
  }
  // In most frames the lower foot is at one height: one that crawls along the axis takes it along.
  bool feetStay(vec3 axis) const {
    std::vector<float> heights;
    for (const MotionPose& pose : poses_) heights.push_back(stance_.lowFoot(pose, axis));
    const auto middle = heights.begin() + std::ptrdiff_t(heights.size() / 2);
    std::ranges::nth_element(heights, middle);
    const float floor = *middle;
    const auto near =
        std::ranges::count_if(heights, [&](float h) { return std::abs(h - floor) < kFootLift * leg_; });
    return 2 * std::size_t(near) > heights.size();
  }
  bool hipsAtLegsHeight(vec3 axis) const {
    float mean = 0;
    for (const MotionPose& pose : poses_) mean += height(pose, axis) / float(poses_.size());
    return mean > kLowestHips * leg_ && mean < kHighestHips * leg_;
  }
  // As of somebody who lies or crawls on a floor: above it in every frame, and not getting up.
  bool hipsAboveFloor(vec3 axis) const {
    float low = height(poses_.front(), axis), high = low;
    for (const MotionPose& pose : poses_)
      low = std::min(low, height(pose, axis)), high = std::max(high, height(pose, axis));
    return low > kLyingHips * leg_ && high < kHighestHips * leg_ && high - low < kLowestHips * leg_;
  }
  bool hipsAtOrigin() const {
    return std::ranges::all_of(poses_, [&](const MotionPose& pose) {
      return glm::length(pose.places[stance_.hips()]) < kLyingHips * leg_;
    });
  }

 private:
  float height(const MotionPose& pose, vec3 axis) const {
    return glm::dot(pose.places[stance_.hips()], axis);
  }

  const RestStance& stance_;
  std::vector<MotionPose> poses_;
  float leg_ = 0;
};

// At most so many of as many numbers from 0 on, the first among them.
std::vector<std::uint32_t> spread(std::uint32_t of, std::uint32_t most) {
  std::vector<std::uint32_t> numbers;
  const std::uint32_t count = std::min(most, of);
  for (std::uint32_t k = 0; k < count; ++k) numbers.push_back(std::uint32_t(std::uint64_t(k) * of / count));
  return numbers;
}

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
  return spread(motion.frameCount, most);
}

std::vector<std::array<std::uint32_t, 2>> sampledSteps(const Motion& motion, float seconds,
                                                       std::uint32_t most) {
  const auto step = std::uint32_t(std::max(1L, std::lround(motion.framesPerSecond * seconds)));
  std::vector<std::array<std::uint32_t, 2>> steps;
  if (motion.frameCount > step)
    for (const std::uint32_t frame : spread(motion.frameCount - step, most))
      steps.push_back({frame, frame + step});
  return steps;
}

// People lie, crawl and swim: how they are stretched out in the frames says little of what is up. A zero pose
// that stands says more. Files whose zero pose stands along one axis and whose motion is along another one
// are told from those of somebody who lies by the root: its height is that of who stands along the other
// axis, and none of who is on a floor along the zero pose's.
vec3 upOf(const Motion& motion, std::span<const std::string_view> parts) {
  const vec3 house(0, 1, 0);
  const RestStance stance(parts);
  const MotionPose zero = motionPose(motion, MotionPose::kZero);
  if (stance.hips() == kNone || !(stance.legLength(zero) > 0)) return house;
  const FramesStance frames(motion, stance);
  const vec3 posed = frames.up(), zeroUp = axisOf(stance.up(zero));
  const bool upright = frames.feetStay(posed), high = frames.hipsAtLegsHeight(posed);
  if (!stance.stands(zero, zeroUp)) return (upright && high) || frames.hipsAtOrigin() ? posed : house;
  if (posed == zeroUp) return posed;
  const int forPosed = int(high) + int(!frames.hipsAboveFloor(zeroUp)) + int(posed == house);
  return upright && forPosed >= 2 ? posed : zeroUp;
}

mat3 uprightTurn(vec3 up) {
  if (up == vec3(0, 1, 0)) return mat3(1);
  const vec3 side = up == vec3(0, -1, 0) ? vec3(1, 0, 0) : glm::cross(vec3(0, 1, 0), up);
  // Rows: what becomes x, y, z. A quarter turn about the axis that is neither, a half turn about x where up
  // was down.
  const vec3 back = glm::cross(side, up);
  mat3 turn = glm::transpose(mat3(side, up, back));
  if (std::abs(up.z) > 0.5f)
    turn = up.z > 0 ? mat3(vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, 1, 0))
                    : mat3(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));
  return turn;
}

Motion withUp(const Motion& motion, vec3 up) {
  if (up == vec3(0, 1, 0)) return motion;
  const mat3 turn = uprightTurn(up);
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
  const MotionPose zero = motionPose(motion, MotionPose::kZero);
  if (stance.stands(zero, {0, 1, 0})) return MotionPose::kZero;
  const auto best = [&](const auto& upright) {
    std::uint32_t found = MotionPose::kZero;
    float most = upright(zero);
    for (const std::uint32_t frame : sampledFrames(motion, kFramesAsked))
      if (const float sum = upright(motionPose(motion, frame)); sum > most + 0.02f) most = sum, found = frame;
    return found;
  };
  const std::uint32_t frame = best([&](const MotionPose& pose) { return stance.uprightness(pose).sum; });
  // Of who lies all the time the frame in which they are stretched out most.
  return frame != MotionPose::kZero
             ? frame
             : best([&](const MotionPose& pose) { return stance.uprightness(pose, stance.up(pose)).sum; });
}

}  // namespace vasa
