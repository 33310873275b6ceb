#include "body/joint_angles.h"

#include <optional>

#include "body/retarget.h"

namespace vasa {
namespace {

vec3 placeOf(const Skeleton& skeleton, std::uint32_t joint) {
  return vec3(skeleton.joints[joint].restWorld[3]);
}

/// Which joints are what, and where the body's front is.
class Anatomy {
 public:
  explicit Anatomy(const Skeleton& skeleton) : skeleton_(skeleton) {
    parts_ = partsOf(skeleton).of;
    if (const auto left = find("leftUpperLeg"), right = find("rightUpperLeg");
        left != kNone && right != kNone)
      left_ = glm::normalize(placeOf(skeleton, left) - placeOf(skeleton, right));
  }

  std::uint32_t find(std::string_view part) const { return partNamed(parts_, part); }

  /// The joints that share a part's motion: in the middle of the body those up to the next part, elsewhere
  /// its own.
  std::vector<std::uint32_t> jointsOf(std::uint32_t joint) const {
    std::vector<std::uint32_t> all{joint};
    const bool middle = !parts_[joint].starts_with("left") && !parts_[joint].starts_with("right");
    for (auto next = onlyWay(joint); middle && next && parts_[*next].empty(); next = onlyWay(*next))
      all.push_back(*next);
    return all;
  }

  /// The turn of one joint, in model space.
  quat turn(std::uint32_t joint, std::string_view part, const JointAngles& angles, float share) const {
    const vec3 front = glm::normalize(glm::cross(left_, vec3(0, 1, 0)));
    const bool left = part.starts_with("left"), right = part.starts_with("right");
    const vec3 link = linkOf(joint, left || right);
    const vec3 bends = part.ends_with("LowerLeg") ? -front : part.ends_with("Foot") ? vec3(0, 1, 0) : front;
    const vec3 away = right ? -left_ : left_;
    const float twist = (right ? -1.0f : 1.0f) * angles.twist;
    return glm::angleAxis(share * angles.flexion, glm::normalize(glm::cross(link, bends))) *
           glm::angleAxis(share * angles.abduction, glm::normalize(glm::cross(link, away))) *
           glm::angleAxis(share * twist, left || right ? link : vec3(0, 1, 0));
  }

 private:
  // The child in the middle of the body, of a joint that is there, too.
  std::optional<std::uint32_t> onlyWay(std::uint32_t joint) const {
    std::optional<std::uint32_t> way;
    float straightest = 0.5f;
    for (std::uint32_t j = joint + 1; j < skeleton_.joints.size(); ++j) {
      if (skeleton_.joints[j].parent.value != joint) continue;
      const vec3 step = placeOf(skeleton_, j) - placeOf(skeleton_, joint);
      const float length = glm::length(step), aside = std::abs(glm::dot(step, left_));
      if (length > 0 && step.y / length > straightest && aside < 0.2f * length)
        way = j, straightest = step.y / length;
    }
    return way;
  }

  vec3 linkOf(std::uint32_t joint, bool limb) const {
    if (!limb) return {0, 1, 0};
    vec3 link(0);
    for (std::uint32_t j = joint + 1; j < skeleton_.joints.size(); ++j)
      if (skeleton_.joints[j].parent.value == joint)
        if (const vec3 step = placeOf(skeleton_, j) - placeOf(skeleton_, joint);
            glm::length(step) > glm::length(link))
          link = step;
    return glm::length(link) > 0 ? glm::normalize(link) : vec3(0, -1, 0);
  }

  const Skeleton& skeleton_;
  std::vector<std::string_view> parts_;
  vec3 left_{1, 0, 0};
};

}  // namespace

Result<Pose> poseByAngles(const Skeleton& skeleton, std::span<const JointAngles> angles, float share) {
  const Anatomy anatomy(skeleton);
  std::vector<JointTransform> local;
  for (const Skeleton::Joint& joint : skeleton.joints) local.push_back(joint.rest);
  for (const JointAngles& own : angles) {
    const std::uint32_t joint = anatomy.find(own.part);
    if (joint == kNone)
      return badInput(
          "no joint of this skeleton is known to be '" + own.part +
          "'; parts are called as in VRM (leftUpperLeg, head), and vasa info --joints lists those of a body");
    const std::vector<std::uint32_t> sharing = anatomy.jointsOf(joint);
    for (const std::uint32_t j : sharing) {
      // In model space about the joint as it is at rest; its parent's own turn comes on top of that.
      const quat turn = anatomy.turn(j, own.part, own, share / float(sharing.size()));
      const mat3 world(skeleton.joints[j].restWorld);
      const quat rest = glm::normalize(
          glm::quat_cast(mat3(glm::normalize(world[0]), glm::normalize(world[1]), glm::normalize(world[2]))));
      local[j].rotation = local[j].rotation * glm::inverse(rest) * turn * rest;
    }
  }
  return poseFromLocal(skeleton, local);
}

}  // namespace vasa
