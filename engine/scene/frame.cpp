#include "scene/frame.h"

#include "core/clock.h"
#include "surface/sweep_table.h"

namespace vasa {

FrameMaker::FrameMaker(const Scene& scene, FrameOptions options)
    : scene_(&scene),
      options_(options),
      deformer_(scene.binding),
      kinks_(scene.network),
      volume_(scene.network),
      beat_(options.beat ? HeartBeat(scene) : HeartBeat()),
      avoider_(options.avoid ? std::make_unique<Avoider>(scene.network, &scene.body, options.avoidance) : nullptr),
      restReferences_(vasa::restReferences(scene.network)),
      references_(restReferences_),
      rotations_(scene.network.points().size()),
      posedPoints_(scene.network.points().begin(), scene.network.points().end()),
      points_(posedPoints_),
      knotFrames_(scene.network.sectionCount()),
      jointMatrices_(scene.body.skeleton.joints.size()) {}

void FrameMaker::make(const Clip* clip, float time) {
  double poseMs = 0;
  Pose pose;
  {
    StageClock clock(poseMs);
    pose = clip ? samplePose(scene_->body.skeleton, *clip, time) : restPose(scene_->body.skeleton);
  }
  make(pose, time);
  report_.poseMs = poseMs;
}

void FrameMaker::make(const Pose& pose, float time) {
  report_ = {};
  heartScale_ = options_.beat ? HeartBeat::scaleAt(time) : 1;
  pose_ = pose;
  for (std::size_t j = 0; j < jointMatrices_.size(); ++j)
    jointMatrices_[j] = pose.world[j] * scene_->body.skeleton.joints[j].inverseBind;
  {
    StageClock clock(report_.deformMs);
    deformer_.run(scene_->network, pose, posedPoints_);
    beat_.apply(heartScale_, jointMatrices_, posedPoints_);
    deformer_.rotations(rotations_);
    for (std::size_t v = 0; v < references_.size(); ++v)
      references_[v] = rotations_[scene_->network.vessels()[v].firstPoint] * restReferences_[v];
  }
  {
    StageClock clock(report_.kinksMs);
    report_.kinks = kinks_.run(posedPoints_);
    pinEnds(scene_->network, posedPoints_);  // what branches off a straightened vessel goes along
  }
  points_ = posedPoints_;
  if (options_.keepVolume) {
    StageClock clock(report_.volumeMs);
    report_.volume = volume_.run(points_);
  }
  if (avoider_)
    report_.avoid = avoider_->run({posedPoints_, rotations_, jointMatrices_}, options_.keepVolume ? &volume_ : nullptr, points_);
  if (avoider_ && options_.keepVolume && report_.avoid.rounds > 0) report_.volume = report_.avoid.volume;
  StageClock clock(report_.framesMs);
  networkFrames(scene_->network, points_, references_, knotFrames_);
}

}  // namespace vasa
