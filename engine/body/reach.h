#pragma once
#include <span>
#include <vector>

#include "body/skeleton.h"

namespace vasa {

/// A joint that takes part in reaching for something.
struct ReachJoint {
  JointId joint;
  quat axes{1, 0, 0, 0};   ///< JointMotion::axes
  vec3 least{0}, most{0};  ///< [rad] of its angles since rest (anglesSinceRest); equal: that one stays
  float stiffness = 1;     ///< how much more than others it would rather stay
};

/// A limb and a point on it that is taken somewhere.
struct ReachLimb {
  std::vector<ReachJoint> joints;  ///< each before those that hang on it, all of them on the way to the tip
  JointId tip;                     ///< the point's joint: the last one, or one below it
  vec3 offset{0};                  ///< of the point in its space
};

struct Reached {
  std::vector<vec3> angles;  ///< [rad] since rest, one a joint of the limb
  vec3 end{0};               ///< [m] where the point is now
  float miss = 0;            ///< [m] from there to the target
};

/// Inverse kinematics: the angles, each within its limits, that take a limb's point to a target, or to the
/// nearest place it can reach. Of the many that do, those nearest to the preferred ones.
///
/// Method: projected Newton (Bertsekas 1982, SIAM J Control Optim 20:221) on half the squared distance plus a
/// millionth of a square metre for each squared radian away from what is preferred (0.01 mm at most where the
/// target can be reached). Where that gets stuck more than 1 mm off it is tried from 16 other starts (Halton
/// 1960); one of these is taken where it gets there, or 5 mm nearer. The result follows the target steadily
/// where one starts from the last result, but for that. A function of its arguments alone.
///
///   ReachLimb arm{{{shoulder, axes, {-1, -2, -1}, {2, 1, 1}}, {elbow, axes2, {0, 0, 0}, {2.5f, 0, 0}}},
///   hand}; const Reached there = reach(skeleton, pose, arm, target, atRest, atRest);
///
/// @param pose       what all other joints do; of the limb's own only where they hang
/// @param target     [m] in the pose's space
/// @param preferred  one a joint
/// @param start      one a joint; the search begins there
/// Some 10 steps, each O(angles² · joints).
Reached reach(const Skeleton& skeleton, const Pose& pose, const ReachLimb& limb, vec3 target,
              std::span<const vec3> preferred, std::span<const vec3> start);

/// Where a limb's point is with these angles.
vec3 endOf(const Skeleton& skeleton, const Pose& pose, const ReachLimb& limb, std::span<const vec3> angles);

}  // namespace vasa
