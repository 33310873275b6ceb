#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "avoid/solver.h"
#include "body/deform.h"
#include "body/pose_path.h"
#include "body/sliding.h"
#include "body/volume.h"
#include "network/kinks.h"
#include "scene/beat.h"
#include "scene/motion_track.h"
#include "scene/scene.h"

namespace vasa {

/// What a frame's stages did and how long they took.
struct FrameReport {
  double poseMs = 0;        ///< clip to joints (by the caller's clock where a pose is given)
  double deformMs = 0;      ///< joints to control points, and vessels along their beds
  double kinksMs = 0;       ///< straightening kinks
  double volumeMs = 0;      ///< radii
  double framesMs = 0;      ///< knot frames
  std::uint32_t kinks = 0;  ///< spans that the pose bent to a kink, before they were straightened
  std::uint32_t steps = 0;  ///< of the motion that led here from the frame before
  VolumeKeeper::Outcome volume;
  AvoidReport avoid;  ///< with the times of its own stages
};

struct FrameOptions {
  Keep keep = Keep::volume;
  bool slide = true;       ///< vessels slide in their beds (body/sliding.h)
  bool avoid = false;      ///< move vessels apart that run through one another
  bool beat = false;       ///< the heart beats (scene/beat.h)
  AvoidOptions avoidance;  ///< budgets; no rounds and lumen rounds: only look
  std::shared_ptr<MotionTrack> track =
      {};  ///< where frames are kept, and taken from if they are of the clip; none: the maker's own
};

/// Turns poses into everything a picture needs: control points, knot frames, joint matrices. The scene must
/// outlive it.
///
/// A motion is solved, not a frame. A frame is a function of scene, clip and time alone: from the rest pose
/// the body goes along a fixed way (body/pose_path.h) to the clip's first pose, and then through the clip
/// frame by frame, in steps whose length follows from the motion and what it brings into one another's way;
/// each starts from the correction of the one before. A time between two frames starts from what lies between
/// both corrections, so that it goes over from one to the other. A pose without a clip is reached from the
/// rest pose in the same way. Frames that were made once are kept (scene/motion_track.h, all or the latest),
/// so that only what is ahead has to be solved.
class FrameMaker {
 public:
  explicit FrameMaker(const Scene& scene, FrameOptions options = {});

  /// @param clip  nullptr: the rest pose
  void make(const Clip* clip, float time);
  /// @param time  of the heart's beat
  void make(const Pose& pose, float time = 0);
  /// On to a pose from where the body is now, whatever led there: for live posing. @param seconds  since then
  void moveTo(const Pose& pose, float time, float seconds);

  /// From now on calls watch() after every step of the way to a pose, and at rest, where ways begin: for
  /// whoever looks between frames. @param watch  or nothing
  void onStep(std::function<void()> watch) { watch_ = std::move(watch); }

  /// Another shape in the same pose, as one that was found for the network before it was edited.
  void put(std::span<const vec4> points);

  const Pose& pose() const { return pose_; }
  std::span<const vec4> points() const { return points_; }
  std::span<const quat> knotFrames() const { return knotFrames_; }
  std::span<const mat4> jointMatrices() const {
    return jointMatrices_;
  }                                                 ///< world · inverse bind; then axial bones'
  float heartScale() const { return heartScale_; }  ///< RenderInput::heartScale
  const FrameReport& report() const { return report_; }
  /// The network as the body alone moves it, without kinks, before vessels were moved apart.
  std::span<const vec4> posedPoints() const { return posedPoints_; }
  /// How the surroundings of each point turned since rest.
  std::span<const quat> rotations() const { return rotations_; }
  /// How the latest frame's pose would be without any correction: a detection more.
  PosedLook lookAtPosed();
  /// Where vessels interfere in the latest frame; null without FrameOptions::avoid.
  const Avoider* avoider() const { return avoider_.get(); }

 private:
  void deform(const Pose& pose, float time);
  void moveBody();
  bool step(const Stride& stride);
  const VolumeKeeper* keeper() const { return options_.keep == Keep::radii ? nullptr : &volume_; }
  void walk(const Pose& target, float fromTime, float time, float seconds);
  void startAtRest();
  void start(const Correction& correction);
  void goTo(const Clip& clip, std::uint32_t frame);
  void resume(const Clip& clip, std::uint32_t frame);
  void goBetween(const Clip& clip, std::uint32_t earlier, float share, float time);
  void begin(const Clip& clip);
  void finish();

  const Scene* scene_;
  FrameOptions options_;
  Deformer deformer_;
  VesselSlider slider_;
  KinkRelaxer kinks_;
  VolumeKeeper volume_;
  HeartBeat beat_;
  float heartScale_ = 1;
  std::unique_ptr<Avoider> avoider_;
  std::shared_ptr<MotionTrack> track_;
  std::optional<std::uint32_t> at_;  // frame of the track where the avoider stands
  Correction known_;                 // of the track
  CorrectionFlow flow_;
  struct Beside {
    Correction correction;
    std::vector<quat> rotations;
  };
  std::array<Beside, 2> beside_;  // the frames before and after a time between them
  std::vector<vec3> restReferences_, references_;
  std::vector<quat> rotations_;
  Pose restPose_;
  Pose pose_, target_;
  PosePath path_;
  std::vector<vec4> posedPoints_, points_;
  std::vector<quat> knotFrames_;
  std::vector<mat4> jointMatrices_;
  FrameReport report_;
  std::function<void()> watch_;
};

}  // namespace vasa
