#include "scene/frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cancellation.h"
#include "core/clock.h"
#include "core/log.h"
#include "surface/sweep_table.h"

namespace vasa {
namespace {

// A joint that turns no farther in one step moves vessels beside one another, some 2 cm from its axis, by 6
// mm. That alone would be much, but a step after which it is not sure on which side something was, or that
// leaves something in something's way, is made in halves. 8 and 12 degrees were measured, too: up to a
// quarter more work, and no fewer jumps.
constexpr float kLongestTurn = 16 * kPi / 180;
// Of that. Quarters and eighths were measured with steps of 8 degrees, too: what passes through one another
// in the pose is caught more often by them, and takes up to four times as long.
constexpr float kShortestStep = 0.5f;
// Steps on end that leave vessels in one another, after which the rest of the way is made at once: in a pose
// that no body takes (limbs through the trunk, by a wrong map of joints) small steps cost as much as large
// ones bring, and what is caught starts anew in the end anyhow. 32 degrees without a gap between limbs are no
// passing touch.
constexpr int kCaught = 4;
constexpr float kStepSeconds = 0.1f;      // of the way from rest to a clip's beginning
constexpr std::uint32_t kRunUp = 15;      // frames before the seam with which a closed clip begins
constexpr std::uint32_t kLongWay = 1000;  // frames: some seconds for a few vessels, minutes for a body's
constexpr float kOnFrame = 1e-3f;         // of a frame: a time so near is the frame's

}  // namespace

FrameMaker::FrameMaker(const Scene& scene, FrameOptions options)
    : scene_(&scene),
      options_(options),
      deformer_(scene.binding),
      slider_(scene.network, &scene.binding, scene.holds),
      kinks_(scene.network),
      volume_(scene.network, options.keep),
      beat_(options.beat ? HeartBeat(scene) : HeartBeat()),
      avoider_(options.avoid ? std::make_unique<Avoider>(scene.network, &scene.body, options.avoidance)
                             : nullptr),
      track_(options.track ? options.track : std::make_shared<MotionTrack>()),
      flow_(scene.network),
      restReferences_(vasa::restReferences(scene.network)),
      references_(restReferences_),
      rotations_(scene.network.points().size()),
      restPose_(restPose(scene.body.skeleton)),
      pose_(restPose_),
      posedPoints_(scene.network.points().begin(), scene.network.points().end()),
      points_(posedPoints_),
      knotFrames_(scene.network.sectionCount()),
      jointMatrices_(scene.body.skeleton.joints.size() + scene.body.axialBones.size()) {
  if (avoider_) startAtRest();
}

void FrameMaker::make(const Clip* clip, float time) {
  if (!clip || !avoider_) {
    double poseMs = 0;
    {
      StageClock clock(poseMs);
      if (clip) samplePose(scene_->body.skeleton, *clip, time, target_);
    }
    make(clip ? target_ : restPose_, time);
    report_.poseMs = poseMs;
    return;
  }
  report_ = {};
  const float rate = clip->framesPerSecond;
  const std::uint32_t last = clip->frameCount() - 1;
  const float place =
      std::clamp((time - clip->start) * rate, 0.0f, std::max((clip->end - clip->start) * rate, float(last)));
  const auto frame = std::uint32_t(std::min(place + kOnFrame, float(last)));
  const float beyond = place - float(frame);
  const bool isBetween = beyond > kOnFrame && frame < last;
  if (track_->isOf(*clip) && frame < track_->first()) begin(*clip);  // both are needed
  goTo(*clip, frame + isBetween);
  if (isBetween) goBetween(*clip, frame, beyond, time);
  if (frame == last && beyond > kOnFrame && !endsOnFrame(*clip)) {
    at_.reset();
    samplePose(scene_->body.skeleton, *clip, time, target_);
    walk(target_, clip->timeOfFrame(last), time, beyond / rate);
  }
  finish();
}

void FrameMaker::make(const Pose& pose, float time) {
  report_ = {};
  if (avoider_) {
    startAtRest();
    path_.set(scene_->body.skeleton, pose_, pose);
    walk(pose, time, time, kStepSeconds * std::max(std::ceil(path_.largestTurn() / kLongestTurn), 1.0f));
  } else {
    deform(pose, time);
    step({.atAnyLength = true, .isLast = true});
  }
  finish();
}

void FrameMaker::moveTo(const Pose& pose, float time, float seconds) {
  report_ = {};
  at_.reset();
  if (avoider_) {
    walk(pose, time, time, seconds);
  } else {
    deform(pose, time);
    step({.atAnyLength = true, .isLast = true});
  }
  finish();
}

// Control points as the pose alone has them.
void FrameMaker::deform(const Pose& pose, float time) {
  heartScale_ = options_.beat ? HeartBeat::scaleAt(time) : 1;
  pose_ = pose;
  {
    StageClock clock(report_.deformMs);
    deformer_.run(scene_->network, pose, posedPoints_);
    moveBody();
    deformer_.rotations(rotations_);
    if (options_.slide) slider_.run(posedPoints_, rotations_);
    beat_.apply(heartScale_, jointMatrices_, posedPoints_);
  }
  StageClock clock(report_.kinksMs);
  report_.kinks = kinks_.run(posedPoints_);
  pinEnds(scene_->network, posedPoints_);  // what branches off a straightened vessel goes along
}

void FrameMaker::moveBody() {
  const Body& body = scene_->body;
  const std::size_t count = body.skeleton.joints.size();
  for (std::size_t j = 0; j < count; ++j)
    jointMatrices_[j] = pose_.world[j] * body.skeleton.joints[j].inverseBind;
  deformer_.axialBones(body, std::span(jointMatrices_).subspan(count));
}

// Vessels in the pose of the last deform(). @return whether the step was made
bool FrameMaker::step(const Stride& stride) {
  if (avoider_) {
    const auto report = avoider_->step({posedPoints_, rotations_, jointMatrices_}, keeper(), stride, points_);
    if (!report) return false;
    const AvoidReport before = std::exchange(report_.avoid, *report);
    report_.avoid.addTimes(before);
    report_.volume = report->volume;
  } else {
    points_ = posedPoints_;
    StageClock clock(report_.volumeMs);
    if (keeper()) report_.volume = volume_.run(points_);
  }
  ++report_.steps;
  return true;
}

// A step that is too long is cut in halves, and what is left of the way is tried anew.
void FrameMaker::walk(const Pose& target, float fromTime, float time, float seconds) {
  path_.set(scene_->body.skeleton, pose_, target);
  const float longest = 1 / std::max(std::ceil(path_.largestTurn() / kLongestTurn), 1.0f);
  int caught = 0;
  for (float done = 0; done < 1;) {
    checkpoint();
    const bool atOnce = caught >= kCaught;
    for (float length = atOnce ? 1 - done : std::min(longest, 1 - done);; length /= 2) {
      const float next = done + length > 1 - 0.5f * kShortestStep * longest ? 1 : done + length;
      deform(path_.at(next), glm::mix(fromTime, time, next));
      if (!step({(next - done) * seconds, atOnce || length <= kShortestStep * longest, next == 1})) continue;
      if (watch_) watch_();
      caught = report_.avoid.after.holds() ? 0 : caught + 1;
      done = next;
      break;
    }
  }
}

void FrameMaker::startAtRest() {
  at_.reset();
  deform(restPose_, 0);
  start({});
  if (watch_) watch_();
}

// Where the body stands now, with a correction that was found before.
void FrameMaker::start(const Correction& correction) {
  report_.avoid = avoider_->start(correction, {posedPoints_, rotations_, jointMatrices_}, keeper(), points_);
  report_.volume = report_.avoid.volume;
}

// Stands at a clip's first frame. A clip that ends where it began is entered by its last frames, so that it
// can go round.
void FrameMaker::begin(const Clip& clip) {
  const Skeleton& skeleton = scene_->body.skeleton;
  const std::uint32_t last = clip.frameCount() - 1;
  const bool round = closes(skeleton, clip);
  std::uint32_t frame = round ? last - std::min(kRunUp, last) : 0;
  samplePose(skeleton, clip, clip.timeOfFrame(frame), target_);
  make(target_, clip.timeOfFrame(frame));
  // The seam is where the last pose is nearly the first one: frame 0 has the first, to the bit.
  const std::uint32_t seam = endsOnFrame(clip) ? last : last + 1;
  while (round && ++frame <= seam) {
    const float time = clip.timeOfFrame(frame < seam ? frame : 0);
    samplePose(skeleton, clip, time, target_);
    walk(target_, clip.timeOfFrame(frame - 1), time,
         frame <= last ? 1 / clip.framesPerSecond : clip.end - clip.timeOfFrame(last));
  }
  track_->restart(clip, avoider_->correction());
  at_ = 0;
}

// Stands where a frame's correction was found before.
void FrameMaker::resume(const Clip& clip, std::uint32_t frame) {
  samplePose(scene_->body.skeleton, clip, clip.timeOfFrame(frame), target_);
  deform(target_, clip.timeOfFrame(frame));
  track_->at(frame, known_);
  start(known_);
  at_ = frame;
}

void FrameMaker::goTo(const Clip& clip, std::uint32_t frame) {
  if (!track_->isOf(clip) || frame < track_->first()) begin(clip);
  const std::uint32_t known = track_->end() - 1;
  if (frame > known + kLongWay)
    logInfo(clip.name + ": frame " + std::to_string(frame) + " follows from those before it, of which " +
            std::to_string(frame - known) + " are solved first");
  if (at_ != std::min(known, frame)) resume(clip, std::min(known, frame));
  for (std::uint32_t next = known + 1; next <= frame; ++next) {
    report_ = {};
    at_.reset();
    samplePose(scene_->body.skeleton, clip, clip.timeOfFrame(next), target_);
    walk(target_, clip.timeOfFrame(next - 1), clip.timeOfFrame(next), 1 / clip.framesPerSecond);
    track_->add(avoider_->correction());
    at_ = next;
  }
}

// At a time between two frames: what is moved aside goes over from the one to the other, so that what one
// frame brings does not come all at once, and is made admissible.
void FrameMaker::goBetween(const Clip& clip, std::uint32_t earlier, float share, float time) {
  at_.reset();
  for (const std::uint32_t k : {0u, 1u}) {
    samplePose(scene_->body.skeleton, clip, clip.timeOfFrame(earlier + k), target_);
    deform(target_, clip.timeOfFrame(earlier + k));
    track_->at(earlier + k, beside_[k].correction);
    beside_[k].rotations = rotations_;
  }
  samplePose(scene_->body.skeleton, clip, time, target_);
  deform(target_, time);
  for (Beside& beside : beside_) flow_.carry(beside.rotations, rotations_, beside.correction.motions);
  CorrectionFlow::mix(beside_[0].correction, share, beside_[1].correction);
  start(beside_[1].correction);
  step({.seconds = 1 / clip.framesPerSecond, .atAnyLength = true, .isLast = true, .inPlace = true});
}

void FrameMaker::put(std::span<const vec4> points) {
  points_.assign(points.begin(), points.end());
  finish();
}

PosedLook FrameMaker::lookAtPosed() {
  std::vector<vec4> points(posedPoints_);
  if (keeper()) volume_.run(points);
  return avoider_->look({posedPoints_, rotations_, jointMatrices_}, points);
}

// What a picture needs besides.
void FrameMaker::finish() {
  StageClock clock(report_.framesMs);
  for (std::size_t v = 0; v < references_.size(); ++v)
    references_[v] = rotations_[scene_->network.vessels()[v].firstPoint] * restReferences_[v];
  networkFrames(scene_->network, points_, references_, knotFrames_);
}

}  // namespace vasa
