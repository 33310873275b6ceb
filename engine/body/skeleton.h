#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/ids.h"
#include "math/types.h"

namespace vasa {

/// Position, rotation and scale of a joint relative to its parent, as in glTF: T · R · S.
struct JointTransform {
  vec3 translation{0};
  quat rotation{1, 0, 0, 0};  // glm's constructor takes w first
  vec3 scale{1};

  mat4 matrix() const;
};

/// A tree (or forest) of joints. Parents come before their children.
struct Skeleton {
  struct Joint {
    std::string name;
    JointId parent;       ///< invalid at a root
    JointTransform rest;  ///< local transform in the rest pose
    mat4 restWorld{1};    ///< model space, rest pose
    mat4 inverseBind{1};  ///< model space of the skinned meshes -> joint space at binding
  };
  std::vector<Joint> joints;
  mat4 rootTransform{1};  ///< of nodes above the root joints

  /// The joint with this name; invalid if there is none.
  JointId find(std::string_view name) const;
};

/// Some of a skeleton's joints, in their order; a joint whose parent is left out becomes a root.
struct JointsKept {
  Skeleton skeleton;
  std::vector<JointId> now;  ///< of each joint that there was; invalid where it is left out
};
JointsKept keepJoints(const Skeleton& skeleton, const std::vector<bool>& kept);

/// Whether a joint is `top` or hangs on it. @param parents  of each joint; JointId::kNone at a root
bool hangsOn(std::span<const std::uint32_t> parents, std::uint32_t joint, std::uint32_t top);

/// A pose: each joint's transform in model space.
struct Pose {
  std::vector<mat4> world;
};

Pose restPose(const Skeleton& skeleton);

/// Chains local transforms down the tree. @param local  one a joint
Pose poseFromLocal(const Skeleton& skeleton, std::span<const JointTransform> local);
/// The same into a pose that was made before: allocates nothing. So does samplePose().
void poseFromLocal(const Skeleton& skeleton, std::span<const JointTransform> local, Pose& pose);

}  // namespace vasa
