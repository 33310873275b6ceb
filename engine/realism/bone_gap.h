#pragma once
#include <optional>

#include "body/body.h"
#include "network/network.h"
#include "realism/vessel_path.h"

namespace vasa {

/// The bones of a body in a pose, posed once for the gaps of any number of vessels.
class PosedBones {
 public:
  /// @param body, pose  must outlive this
  PosedBones(const Body& body, const Pose& pose);

  const Body& body() const { return *body_; }
  const Pose& pose() const { return *pose_; }
  /// [m] from a place to the nearest bone.
  float distance(vec3 place) const;

 private:
  struct Bone {
    const TriangleMesh* mesh;
    std::vector<vec3> positions;
  };
  const Body* body_;
  const Pose* pose_;
  std::vector<Bone> bones_;
};

/// How far a vessel's wall is from the nearest bone: where the path passes a level of a limb that moves with
/// its joint, or where it is nearest.
/// @param joint   the limb's joint
/// @param level   [m] above where the joint's own bone begins below it, at rest (body upright)
/// @param points  as Network::points(), in the pose
/// @return [m] from the surface of the wall to that of the bone
/// O(stations looked at · triangles of the bones + their vertices)
float boneGap(const PosedBones& bones, JointId joint, std::optional<float> level, const Network& network,
              const VesselPath& path, std::span<const vec4> points);

}  // namespace vasa
