#include "io/bvh_turns.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "body/rest_stance.h"
#include "body/rig.h"

namespace vasa {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr std::uint32_t kStepsAsked = 48;
// Shorter ones are within a recording's noise, in longer ones feet change.
constexpr float kStepSeconds = 1.0f / 15;
constexpr float kGoes = 0.03f;  // of a leg: the hips' least way in a step that tells, 0.4 m a second
constexpr std::size_t kLeastSteps = 8;
// The foot's way beside the hips': as recorded it is 0.06 to 0.15 (walks, somebody who bends and lifts), in
// another order 0.2 to 2.
constexpr float kStandsStill = 0.2f, kSlides = 3;  // times the way in the order in which it stands

// Median of the standing foot's way beside the hips'; nothing where too few steps tell.
std::optional<float> slideOf(const Motion& motion, std::span<const std::array<std::uint32_t, 2>> steps,
                             const RestStance& stance) {
  std::vector<float> slides;
  for (const auto& [from, to] : steps) {
    const MotionPose before = motionPose(motion, from);
    const auto step = stance.standingStep(before, motionPose(motion, to));
    const float far = step ? glm::length(step->hips) : 0;
    if (far > kGoes * stance.legLength(before)) slides.push_back(glm::length(step->hips + step->foot) / far);
  }
  if (slides.size() < kLeastSteps) return std::nullopt;
  const auto middle = slides.begin() + std::ptrdiff_t(slides.size() / 2);
  std::ranges::nth_element(slides, middle);
  return *middle;
}

std::string namesOf(const std::array<int, 3>& axes) {
  constexpr const char* kNames[] = {"Xrotation", "Yrotation", "Zrotation"};
  std::string names = kNames[axes[0]];
  for (const int k : {1, 2}) names.append(1, ' ').append(kNames[axes[std::size_t(k)]]);
  return names;
}

}  // namespace

void addBvhPose(std::span<const BvhChannel> channels, std::span<const double> values, const BvhTurns* other,
                Motion& motion, std::size_t joint) {
  vec3 place = motion.joints[joint].offset;
  struct Turn {
    int axis;
    double degrees;
  };
  std::array<Turn, 6> room;  // a joint has no more channels
  std::size_t count = 0;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (channels[c] <= BvhChannel::z)
      place[int(channels[c])] = float(values[c]);
    else
      room[count++] = {int(channels[c]) - int(BvhChannel::turnX), values[c]};
  const std::span turns(room.data(), count);
  if (other && turns.size() == 3) {
    if (other->columns)
      for (std::size_t k = 0; k < 3; ++k) turns[k].axis = other->axes[k];
    else
      std::ranges::stable_sort(turns, {}, [&](const Turn& turn) {
        return std::ranges::find(other->axes, turn.axis) - other->axes.begin();
      });
  }
  glm::dquat sum(1, 0, 0, 0);
  for (const auto& [axis, degrees] : turns) {
    dvec3 along(0);
    along[axis] = 1;
    sum = sum * glm::angleAxis(degrees * kRadians, along);
  }
  motion.rotations.push_back(quat(glm::normalize(sum)));
  motion.translations.push_back(place);
}

BvhSteps::BvhSteps(const Motion& motion) : steps_(sampledSteps(motion, kStepSeconds, kStepsAsked)) {
  for (const auto& ends : steps_) frames_.insert(frames_.end(), ends.begin(), ends.end());
  std::ranges::sort(frames_);
  frames_.erase(std::unique(frames_.begin(), frames_.end()), frames_.end());
  for (auto& ends : steps_)
    for (std::uint32_t& end : ends)
      end = std::uint32_t(std::ranges::lower_bound(frames_, end) - frames_.begin());
}

void BvhSteps::take(std::uint32_t frame, std::span<const double> values) {
  if (std::ranges::binary_search(frames_, frame)) values_.insert(values_.end(), values.begin(), values.end());
}

std::string BvhSteps::otherTurns(const Motion& motion,
                                 std::span<const std::vector<BvhChannel>> channels) const {
  const HumanoidNames parts = rigOf(motion).parts;
  const RestStance stance(parts.of);
  if (steps_.size() < kLeastSteps || stance.hips() == kNone) return {};
  const auto slide = [&](const BvhTurns* turns) {
    Motion read;
    read.joints = motion.joints;
    read.frameCount = std::uint32_t(frames_.size());
    std::span<const double> values = values_;
    for (std::size_t frame = 0; frame < frames_.size(); ++frame)
      for (std::size_t j = 0; j < channels.size(); ++j) {
        addBvhPose(channels[j], values.first(channels[j].size()), turns, read, j);
        values = values.subspan(channels[j].size());
      }
    return slideOf(read, steps_, stance);
  };
  const std::optional<float> own = slide(nullptr);
  if (!own) return {};
  std::optional<BvhTurns> best;
  float least = std::min(*own / kSlides, kStandsStill);
  for (const bool columns : {true, false}) {
    BvhTurns turns{{0, 1, 2}, columns};
    do
      if (const auto other = slide(&turns); other && *other < least) best = turns, least = *other;
    while (std::ranges::next_permutation(turns.axes).found);
  }
  if (!best) return {};
  const auto percent = [](float share) { return std::to_string(std::lround(100 * share)) + " %"; };
  return "its feet slide by " + percent(*own) + " of the hips' way, and by " + percent(least) +
         " where turns are read " +
         (best->columns ? "as CHANNELS " + namesOf(best->axes) + ": write the channels so"
                        : "in the order " + namesOf(best->axes) + ": export it in that order") +
         ", unless it was recorded so";
}

}  // namespace vasa
