#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "body/skeleton.h"

namespace vasa::viewer {

/// What a person turned a joint by, in its own axes, after whatever the clip does with it.
struct JointTurn {
  JointId joint;
  vec3 angles{0};  ///< [rad] about x, then y, then z
};

/// The pose with these joints turned, and what hangs on them along.
Pose turned(const Skeleton& skeleton, const Pose& pose, std::span<const JointTurn> turns);

/// How far a joint may be turned in all [rad], by what it is in a body (body/humanoid.h): a wrist less than a knee. Which
/// way a joint bends is not known. @param role  empty: unknown
float mostTurn(std::string_view role);

/// A turn about an axis of the world on top of what a joint is turned already, cut off at `most`.
/// @param world  of the joint, as it is turned now
vec3 turnedFurther(vec3 angles, const mat4& world, vec3 axis, float angle, float most);

/// Angles cut off so that the turn in all is `most` or less.
vec3 withinLimit(vec3 angles, float most);

}  // namespace vasa::viewer
