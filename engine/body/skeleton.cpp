#include "body/skeleton.h"

#include <cassert>

namespace vasa {

mat4 JointTransform::matrix() const {
  mat4 m = glm::mat4_cast(rotation);
  m[0] *= scale.x;
  m[1] *= scale.y;
  m[2] *= scale.z;
  m[3] = vec4(translation, 1);
  return m;
}

JointId Skeleton::find(std::string_view name) const {
  for (std::uint32_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == name) return {i};
  return {};
}

JointsKept keepJoints(const Skeleton& skeleton, const std::vector<bool>& kept) {
  JointsKept out;
  out.skeleton.rootTransform = skeleton.rootTransform;
  out.now.resize(skeleton.joints.size());
  auto& joints = out.skeleton.joints;
  for (std::size_t j = 0; j < kept.size(); ++j) {
    if (!kept[j]) continue;
    out.now[j] = {std::uint32_t(joints.size())};
    joints.push_back(skeleton.joints[j]);
    if (JointId& parent = joints.back().parent; parent.valid()) parent = out.now[parent.value];
  }
  return out;
}

bool hangsOn(std::span<const std::uint32_t> parents, std::uint32_t joint, std::uint32_t top) {
  for (; joint != JointId::kNone; joint = parents[joint])
    if (joint == top) return true;
  return false;
}

Pose restPose(const Skeleton& skeleton) {
  Pose pose;
  pose.world.reserve(skeleton.joints.size());
  for (const auto& joint : skeleton.joints) pose.world.push_back(joint.restWorld);
  return pose;
}

void poseFromLocal(const Skeleton& skeleton, std::span<const JointTransform> local, Pose& pose) {
  assert(local.size() == skeleton.joints.size());
  pose.world.resize(local.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    const JointId parent = skeleton.joints[i].parent;
    const mat4& above = parent.valid() ? pose.world[parent.value] : skeleton.rootTransform;
    pose.world[i] = above * local[i].matrix();
  }
}

Pose poseFromLocal(const Skeleton& skeleton, std::span<const JointTransform> local) {
  Pose pose;
  poseFromLocal(skeleton, local, pose);
  return pose;
}

}  // namespace vasa
