#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/joint_motion.h"
#include "body/reach.h"
#include "io/joint_range.h"

namespace vasa::viewer {

/// A place of the body that can be taken hold of, and what moves when it is pulled.
struct Grip {
  std::string name;      ///< "left wrist"
  ReachLimb limb;        ///< of which the tip is the place; limits as of a pose at rest
  bool fine = false;     ///< on a hand: gives way to others where they lie on one another
  bool carries = false;  ///< the whole body hangs on it: pulled, it moves and does not turn
};

/// A skeleton as something to pose: what its joints are called and how far they go, where it can be taken
/// hold of. Joints that only follow, as one that spreads the forearm's twist, are no place to take hold of
/// and bend nowhere; they take a rotation that anatomists count to their limb.
class Mannequin {
 public:
  Mannequin() = default;
  /// @param ranges  how far joints go from hanging arms (data/realism/ranges.csv); what is not in it goes as
  /// far as jointMotion() says
  Mannequin(const Skeleton& skeleton, std::span<const JointRange> ranges);

  std::span<const Grip> grips() const { return grips_; }
  const JointMotion& motion(JointId joint) const { return motions_[joint.value]; }
  /// "left elbow"; the rig's own name where people have none.
  const std::string& nameOf(JointId joint) const { return names_[joint.value]; }
  /// body/humanoid.h; of a joint that takes its limb's rotation the limb's part.
  std::string_view partOf(JointId joint) const { return parts_[joint.value]; }
  /// The joint that is a part of a body; invalid where there is none.
  JointId find(std::string_view part) const;
  /// Joints that can be turned, those that people have a name for first.
  std::span<const std::uint32_t> listed() const { return listed_; }
  /// The same joint on the body's other side; itself in the middle.
  JointId twinOf(JointId joint) const { return twins_[joint.value]; }

 private:
  void nameJoints(const Skeleton& skeleton);
  void nameFingers(const Skeleton& skeleton, JointId hand, std::string_view side);
  void limitJoints(const Skeleton& skeleton, std::span<const JointRange> ranges);
  void findTwins(const Skeleton& skeleton);
  void findGrips(const Skeleton& skeleton);
  void gripHand(const Skeleton& skeleton, JointId joint);
  ReachJoint turning(JointId joint) const;

  std::vector<std::string_view> parts_;
  std::vector<std::string> names_;
  std::vector<JointMotion> motions_;
  std::vector<JointId> twins_;
  std::vector<char> rolls_;  // takes its limb's rotation
  std::vector<Grip> grips_;
  std::vector<std::uint32_t> listed_;
};

/// The turns on the body's other side. What lies in the middle is turned to the other side, too.
std::vector<JointTurn> mirroredTurns(const Mannequin& mannequin, std::span<const JointTurn> turns);

}  // namespace vasa::viewer
