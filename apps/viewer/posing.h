#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "body/skeleton.h"

namespace vasa::viewer {

/// How a joint turns in a human body: about three axes, perpendicular to one another at rest, and how far
/// about each.
///   x  bend: takes what hangs on the joint forwards (a foot: up)
///   y  spread: takes it sideways, towards the body's right where it hangs down
///   z  twist: about its own length
struct JointMotion {
  quat axes{1, 0, 0, 0};                ///< from those axes to the joint's own
  vec3 least{-kPi / 2}, most{kPi / 2};  ///< [rad]

  vec3 within(vec3 angles) const { return glm::clamp(angles, least, most); }
};
/// By the rest pose, in which the body stands along +Y and faces +Z, and by what the joint is
/// (body/humanoid.h). Ranges: AAOS 1965, rounded up; of a finger's bend both ways, because palms face any way
/// at rest.
/// @param role  empty: unknown, 90 degrees each way
JointMotion jointMotion(const Skeleton& skeleton, JointId joint, std::string_view role);

/// What a person turned a joint by, after whatever the clip does with it.
struct JointTurn {
  JointId joint;
  vec3 angles{0};         ///< [rad] about x, then y, then z of JointMotion::axes
  quat axes{1, 0, 0, 0};  ///< JointMotion::axes

  bool operator==(const JointTurn&) const = default;
};

/// The pose with these joints turned, and what hangs on them along.
Pose turned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns);

/// A turn about an axis of the world on top of what a joint is turned already, within its range.
/// @param world  of the joint, as it is turned now
vec3 turnedFurther(vec3 angles, const JointMotion& motion, const mat4& world, vec3 axis, float angle);

}  // namespace vasa::viewer
