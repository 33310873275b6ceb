#include "body/pose_path.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

JointTransform decomposed(const mat4& matrix) {
  JointTransform out;
  out.translation = vec3(matrix[3]);
  mat3 axes(matrix);
  for (int k = 0; k < 3; ++k) {
    out.scale[k] = glm::length(axes[k]);
    if (out.scale[k] > 0) axes[k] /= out.scale[k];
  }
  if (glm::determinant(axes) < 0) out.scale.x = -out.scale.x, axes[0] = -axes[0];
  out.rotation = glm::normalize(glm::quat_cast(axes));
  return out;
}

void localOf(const Skeleton& skeleton, const Pose& pose, std::vector<JointTransform>& local) {
  local.clear();
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    const mat4& above = parent.valid() ? pose.world[parent.value] : skeleton.rootTransform;
    local.push_back(decomposed(glm::inverse(above) * pose.world[j]));
  }
}

}  // namespace

void PosePath::set(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  skeleton_ = &skeleton;
  from_ = from;
  to_ = to;
  localOf(skeleton, from, start_);
  localOf(skeleton, to, end_);
}

const Pose& PosePath::at(float share) {
  if (share <= 0) return from_;
  if (share >= 1) return to_;
  local_.resize(start_.size());
  for (std::size_t j = 0; j < start_.size(); ++j)
    local_[j] = {glm::mix(start_[j].translation, end_[j].translation, share),
                 glm::slerp(start_[j].rotation, end_[j].rotation, share),
                 glm::mix(start_[j].scale, end_[j].scale, share)};
  poseFromLocal(*skeleton_, local_, between_);
  return between_;
}

float PosePath::largestTurn() const {
  float largest = 0;
  for (std::size_t j = 0; j < start_.size(); ++j) {
    if (!skeleton_->joints[j].parent.valid()) continue;
    const quat turn = glm::conjugate(start_[j].rotation) * end_[j].rotation;
    largest = std::max(largest, 2 * std::atan2(glm::length(vec3(turn.x, turn.y, turn.z)), std::abs(turn.w)));
  }
  return largest;
}

}  // namespace vasa
