#pragma once
#include <span>
#include <string_view>

#include "body/skeleton.h"

namespace vasa {

/// How a joint turns in a human body: about three axes, perpendicular to one another at rest, and how far
/// about each.
///   x  bend: takes what hangs on the joint forwards (a foot: up)
///   y  spread: takes it sideways, towards the body's right where it hangs down
///   z  twist: about its own length
/// Bend and spread are one turn about an axis across the bone, so that no order between them matters and no
/// pose short of a half turn is singular; the twist comes before it, about the bone as it is at rest.
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

/// What a person turned a joint by, and moved it by, after whatever the clip does with it.
struct JointTurn {
  JointId joint;
  vec3 angles{0};         ///< [rad] bend, spread and twist of JointMotion
  quat axes{1, 0, 0, 0};  ///< JointMotion::axes
  vec3 moved{0};          ///< [m] in model space; of the pelvis, which has nothing to hang on

  bool any() const { return angles != vec3(0) || moved != vec3(0); }
  bool operator==(const JointTurn&) const = default;
};

/// The pose with these joints turned and moved, and what hangs on them along.
Pose turned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns);
/// The pose that turned() made this one of.
Pose unturned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns);

/// The turn that bend, spread and twist make, about JointMotion's axes; and back, for turns whose bend and
/// spread together are less than a half turn.
quat turnByAngles(vec3 angles);
vec3 anglesOfTurn(quat turn);

/// A joint's angles since rest where a pose has it, about JointMotion's axes.
/// @param before  the pose's transform of its parent; the skeleton's rootTransform at a root
vec3 anglesSinceRest(const Skeleton::Joint& joint, const JointMotion& motion, const mat4& before,
                     const mat4& world);

/// What a joint has to be turned by, beside a pose, to be at these angles since rest.
/// @param before, world  of its parent and of itself in that pose, as it is without the turn
vec3 anglesBeside(const Skeleton::Joint& joint, const JointMotion& motion, const mat4& before,
                  const mat4& world, vec3 sinceRest);

/// What a joint on one side of the body is turned by where its twin on the other is turned by these angles.
inline vec3 mirroredAngles(vec3 angles) { return {angles.x, -angles.y, -angles.z}; }

/// A turn about an axis of the world on top of what a joint is turned already, within its range.
/// @param world  of the joint, as it is turned now
vec3 turnedFurther(vec3 angles, const JointMotion& motion, const mat4& world, vec3 axis, float angle);

}  // namespace vasa
