#pragma once
#include <memory>

#include "avoid/solver.h"
#include "body/deform.h"
#include "body/volume.h"
#include "network/kinks.h"
#include "scene/beat.h"
#include "scene/scene.h"

namespace vasa {

/// What a frame's stages did and how long they took.
struct FrameReport {
  double poseMs = 0;    ///< clip to joints (by the caller's clock where a pose is given)
  double deformMs = 0;  ///< joints to control points
  double kinksMs = 0;   ///< straightening kinks
  double volumeMs = 0;  ///< radii
  double framesMs = 0;  ///< knot frames
  std::uint32_t kinks = 0;  ///< spans that the pose bent to a kink, before they were straightened
  VolumeKeeper::Outcome volume;
  AvoidReport avoid;             ///< with the times of its own stages
};

struct FrameOptions {
  bool keepVolume = true;
  bool avoid = false;        ///< move vessels apart that run through one another
  bool beat = false;         ///< the heart beats (scene/beat.h)
  AvoidOptions avoidance;    ///< budgets; no rounds and lumen rounds: only look
};

/// Turns poses into everything a picture needs: control points, knot frames, joint matrices. A frame depends on the
/// scene and the pose alone. The scene must outlive it.
class FrameMaker {
 public:
  explicit FrameMaker(const Scene& scene, FrameOptions options = {});

  /// @param clip  nullptr: the rest pose
  void make(const Clip* clip, float time);
  /// @param time  of the heart's beat
  void make(const Pose& pose, float time = 0);

  const Pose& pose() const { return pose_; }
  std::span<const vec4> points() const { return points_; }
  std::span<const quat> knotFrames() const { return knotFrames_; }
  std::span<const mat4> jointMatrices() const { return jointMatrices_; }  ///< world · inverse bind
  float heartScale() const { return heartScale_; }  ///< RenderInput::heartScale
  const FrameReport& report() const { return report_; }
  /// The network as the body alone moves it, without kinks, before vessels were moved apart.
  std::span<const vec4> posedPoints() const { return posedPoints_; }
  /// How the surroundings of each point turned since rest.
  std::span<const quat> rotations() const { return rotations_; }
  /// Where vessels interfered in the latest frame; null without FrameOptions::avoid.
  const Avoider* avoider() const { return avoider_.get(); }

 private:
  const Scene* scene_;
  FrameOptions options_;
  Deformer deformer_;
  KinkRelaxer kinks_;
  VolumeKeeper volume_;
  HeartBeat beat_;
  float heartScale_ = 1;
  std::unique_ptr<Avoider> avoider_;
  std::vector<vec3> restReferences_, references_;
  std::vector<quat> rotations_;
  Pose pose_;
  std::vector<vec4> posedPoints_, points_;
  std::vector<quat> knotFrames_;
  std::vector<mat4> jointMatrices_;
  FrameReport report_;
};

}  // namespace vasa
