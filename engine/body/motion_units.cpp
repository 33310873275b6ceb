#include "body/motion_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "body/rest_stance.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::uint32_t kStepsAsked = 256;
constexpr float kStepSeconds = 1.0f / 30;
constexpr float kStill = 0.002f;    // of a leg: a step in which the foot moves less tells nothing
constexpr float kAgainst = 0.8f;    // least cosine between the foot's way and the opposite of the hips'
constexpr std::size_t kLeast = 8;   // steps that agree
constexpr float kAgree = 1.3f;      // times: in the amount
constexpr float kOneUnit = 2;       // times: as of roots whose way was made a little longer or shorter
constexpr float kNearRatio = 1.2f;  // times from a ratio of two units
constexpr std::array kRatios{1000.0f, 100.0f, 39.37f, 25.4f, 10.0f, 2.54f};

bool differ(float times) { return times > kOneUnit || times < 1 / kOneUnit; }

float nearestRatio(float times) {
  for (const float ratio : kRatios)
    for (const float own : {ratio, 1 / ratio})
      if (times < own * kNearRatio && times > own / kNearRatio) return own;
  return times;
}

// What the feet of a motion say of its places: how many times too short its hips' way is.
float timesByFeet(const Motion& motion, const RestStance& stance) {
  std::vector<float> times;
  std::size_t telling = 0;
  for (const auto& [from, to] : sampledSteps(motion, kStepSeconds, kStepsAsked)) {
    const MotionPose before = motionPose(motion, from);
    const auto step = stance.standingStep(before, motionPose(motion, to));
    const float far = step ? glm::length(step->foot) : 0;
    if (!(far > kStill * stance.legLength(before))) continue;
    ++telling;
    if (const float hips = glm::length(step->hips);
        hips > 0 && -glm::dot(step->foot, step->hips) > kAgainst * far * hips)
      times.push_back(far / hips);
  }
  if (times.size() < kLeast) return 1;
  std::ranges::sort(times);
  const float middle = times[times.size() / 2];
  const auto agree = std::size_t(std::ranges::count_if(
      times, [&](float own) { return own < middle * kAgree && own > middle / kAgree; }));
  return agree < kLeast || 2 * agree < telling ? 1 : middle;
}

}  // namespace

double metresAUnit(const Motion& motion, std::span<const std::string_view> parts) {
  const double leg = double(RestStance(parts).legLength(motionPose(motion, MotionPose::kZero)));
  for (const double unit : {1.0, 0.01, 0.0254, 0.0564, 0.001})
    if (leg * unit > 0.45 && leg * unit < 1.15) return unit;
  return 0;
}

MotionUnits motionUnits(const Motion& motion, std::span<const std::string_view> parts) {
  MotionUnits units;
  const RestStance stance(parts);
  if (stance.hips() == kNone || motion.frameCount == 0) return units;
  const float zero = stance.legLength(motionPose(motion, MotionPose::kZero)),
              first = stance.legLength(motionPose(motion, 0));
  if (!(zero > 0) || !(first > 0)) return units;
  if (differ(first / zero)) {
    units.offsets = first / zero;
  } else if (const float times = timesByFeet(motion, stance); differ(times)) {
    units.places = nearestRatio(times);
  }
  return units;
}

Motion inOneUnit(Motion motion, const MotionUnits& units) {
  if (units.one()) return motion;
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    Motion::Joint& joint = motion.joints[j];
    joint.offset *= units.offsets, joint.endOffset *= units.offsets;
    const float times = joint.moves ? units.places : units.offsets;
    for (std::size_t frame = 0; frame < motion.frameCount; ++frame)
      motion.translations[frame * motion.joints.size() + j] *= times;
  }
  return motion;
}

std::string describeUnits(const MotionUnits& units) {
  if (units.one()) return {};
  char times[32];
  std::snprintf(times, sizeof times, "%.3g", double(units.places != 1 ? units.places : units.offsets));
  return units.places != 1
             ? std::string("its root moves in another unit than its OFFSETs: the way is taken ") + times +
                   " times as long, so that feet stay where they stand"
             : std::string(
                   "its OFFSETs are in another unit than the places of its joints in frames, and are "
                   "taken ") +
                   times + " times as long";
}

}  // namespace vasa
