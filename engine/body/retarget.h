#pragma once
#include "body/body.h"
#include "body/humanoid.h"
#include "body/motion.h"
#include "core/result.h"

namespace vasa {

/// A clip in which a body does what a motion's skeleton did.
///
/// Joints that the map pairs follow one another; of the rest those with the same name, where both skeletons are
/// of one family (body/humanoid.h), or else those that are the same part of a human body. A joint turns in space
/// as the one it follows does. The two rest poses may differ: upper and lower limbs are first turned so that
/// their bones point as the motion's do at rest (from arms that hang to arms stretched out), hands so that also
/// their thumbs do; trunk, head, collar bones and feet are taken to be upright and flat in both. A joint between
/// elbow and wrist that follows nothing takes the hand's turning about the forearm; one that shares its centre
/// with a sibling that does follow (a knee cap) takes part of that one's turn; others stay as they are at rest.
/// The hips go as the motion's do, times the legs' lengths against one another, from where the body stands,
/// raised or lowered once for the whole clip so that the feet meet the floor they stand on at rest.
///
/// Fails with badInput that names both and what is missing: the map names a joint that does not exist, no hips,
/// fewer than six joints that follow one.
/// O(frames · joints).
Result<Clip> retarget(const Motion& motion, const Body& body, const JointMap& map = {});

/// The joint of the motion that each joint of the body follows, as above; JointId::kNone where there is none.
Result<std::vector<std::uint32_t>> matchedJoints(const Motion& motion, const Body& body, const JointMap& map = {});

}  // namespace vasa
