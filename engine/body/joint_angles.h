#pragma once
#include <span>
#include <string>

#include "body/body.h"
#include "core/result.h"

namespace vasa {

/// How far a part of the body leaves the rest pose, as anatomists say it [rad].
struct JointAngles {
  std::string part;     ///< in the words of the VRM humanoid: "leftUpperLeg", "neck" (body/humanoid.h)
  float flexion = 0;    ///< hip, shoulder, elbow, spine: forwards; knee: backwards; foot: upwards
  float abduction = 0;  ///< away from the midline; in the middle of the body: to the left
  float twist = 0;      ///< about the limb, inwards; in the middle of the body: to the left
};

/// A pose by its joints' angles; what is not named stays as it is at rest. Axes follow from the skeleton at
/// rest, in which the body stands upright with hanging arms. Angles of a part of the spine or neck are shared
/// by the joints from it up to the next part.
/// @param share  of all angles
/// Fails with badInput that names the part which the skeleton does not have, or that can not be told by its
/// joints' names.
Result<Pose> poseByAngles(const Skeleton& skeleton, std::span<const JointAngles> angles, float share = 1);

}  // namespace vasa
