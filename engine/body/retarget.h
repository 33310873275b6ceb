#pragma once
#include "body/body.h"
#include "body/humanoid.h"
#include "body/joint_pairs.h"
#include "body/motion.h"
#include "core/result.h"

namespace vasa {

/// A motion carried to a body, and what is known of how well.
struct Retargeting {
  static constexpr std::uint32_t kZeroPose = 0xffffffffu;
  Clip clip;
  std::vector<std::uint32_t>
      source;  ///< one a joint of the body: the motion's joint that it follows, or JointId::kNone
  std::string_view motionNames, bodyNames;  ///< the convention (body/humanoid.h), "words", "shape" or nothing
  std::vector<std::string_view> motionParts;  ///< what each joint of the motion is
  int joints = 0, keys = 0;                   ///< that follow one; of kHumanoidKeys
  float sureness = 0;                         ///< 0 to 1, as below
  float meanAngle = 0, worstAngle = 0;        ///< [degrees] between the limbs of both, in some of the frames
  std::uint32_t standingFrame = kZeroPose;    ///< the motion's pose that is compared with the body's rest
  bool stands = true;                         ///< in it trunk and legs are in a line, as far as is known
  vec3 up{0, 1, 0};                           ///< the motion's axis that was taken for up
  /// [degrees] The most that the trunk's bend lacks in those of some frames in which it is less than half of
  /// the motion's.
  float trunkMissing = 0;
  /// "'Head' above 'Hips'": two joints of the body of which the first carries the second, though the one that
  /// the second follows carries the first's; empty: there are none.
  std::string turnedRound;
};
constexpr float kLeastSureness = 0.5f;
constexpr float kTrunkFollowed = 15;  ///< [degrees] trunkMissing beyond which the trunk is not followed

/// A clip in which a body does what a motion's skeleton did.
///
/// Joints that the map pairs follow one another; of the rest those with the same name, where both skeletons
/// are of one family (body/humanoid.h), or else those that are the same part of a human body, by name or,
/// where names tell less than half of it, by the skeleton's shape (body/humanoid_shape.h). The joints between
/// hips and neck are paired from low to high where both have as many, whatever they are called; else by their
/// parts, where the motion has no others there and both have the same; else each of the body's takes shares
/// of two of the motion's (body/trunk_spread.h). The motion is turned so that +Y is up, where its trunk
/// stands along another axis. A joint turns in space as the one it follows does. The two rest poses may
/// differ: the motion's is its zero pose, or the frame in which it stands most upright where that is none of
/// a person (body/motion_rest.h). Upper and lower limbs are first turned so that their bones point as the
/// motion's do there (from arms that hang to arms stretched out), hands so that also their thumbs do; the
/// trunk, where both differ by more than 30 degrees; head, collar bones and feet are taken to be upright and
/// flat in both. A joint between elbow and wrist that follows nothing takes the hand's turning about the
/// forearm; one that shares its centre with a sibling that does follow (a knee cap) takes part of that one's
/// turn; others stay as they are at rest. The hips go as the motion's do, times the legs' lengths against one
/// another, from where the body stands, raised or lowered once for the whole clip so that the feet meet the
/// floor they stand on at rest.
///
/// Sureness is the share of the fourteen parts that make a person move (of those that either has), times 0.95
/// where only words and 0.8 where only the shape told them, times the square of the share of what must hold
/// between them that does (shins behind thighs, both sides alike, legs away from the trunk), less where limbs
/// end up more than 10 degrees from the motion's, times 0.8 where the trunk bends against the hips by less
/// than half of what the motion's does, and by more than kTrunkFollowed less, times 0.7 where nobody stands
/// in the pose that is compared with rest, or feet slide that would stand in another order of the motion's
/// turns, and times 0.4 where joints are paired that stand the other way round (a map with hips and head
/// exchanged).
///
/// Fails with badInput that names both and what is missing: the map names a joint that does not exist, no
/// hips, fewer than six joints that follow one; without a map, sureness below kLeastSureness. O(frames ·
/// joints).
Result<Retargeting> retargeted(const Motion& motion, const Body& body, const JointMap& map = {});

/// The clip alone.
Result<Clip> retarget(const Motion& motion, const Body& body, const JointMap& map = {});

/// "23 joints matched, 14 of the 14 that make a person move (names: motion biovision, body cmu), 100 % sure"
std::string describeMatch(const Retargeting& done);

/// A body at rest as a motion of one frame: retargeting it poses another body the same way.
Motion standingStill(const Body& body);

/// What the joints are, by name or by shape.
HumanoidNames partsOf(const Motion& motion);
HumanoidNames partsOf(const Skeleton& skeleton);

/// What follows what, as above.
Result<JointPairs> matchedJoints(const Motion& motion, const Body& body, const JointMap& map = {});

}  // namespace vasa
