#pragma once
#include <span>

#include "body/binding.h"

namespace vasa {

/// Moves bound points with a pose, frame after frame. The result depends on the binding and the pose only.
///
///   Deformer deformer(binding);
///   deformer.run(network, samplePose(body.skeleton, clip, time), points);
class Deformer {
 public:
  /// @param binding  must outlive this
  explicit Deformer(const Binding& binding) : binding_(&binding), pose_(binding.spines) {}

  /// Moves every point of a network and pins the vessels' ends to their nodes. Radii are those at rest.
  /// O(points), no allocation. @param out  as network.points()
  void run(const Network& network, const Pose& pose, std::span<vec4> out);

  /// Moves plain points. @param rest  the bound points; @param out  of the same size
  void run(std::span<const vec4> rest, const Pose& pose, std::span<vec4> out);

  /// Where a direction or frame at each point turns to: the rotation of the limb with the largest share. For
  /// reference directions of frames. @param out  one a point
  void rotations(std::span<quat> out) const;

  /// Where the body's axial bones are in the pose of the last run. A rib hangs on its vertebra and turns
  /// about its root, by the shortest way, to where the flesh takes its front end.
  /// @param body  which the points are bound to  @param out  as skinMatrices() has them, one a bone
  void axialBones(const Body& body, std::span<mat4> out) const;

  /// The spines in the pose of the last run.
  const SpinePose& spines() const { return pose_; }

 private:
  const Binding* binding_;
  SpinePose pose_;
};

}  // namespace vasa
