#pragma once
#include <string_view>
#include <vector>

#include "body/skeleton.h"
#include "core/result.h"

namespace vasa {

/// One joint of a limb's spine and the link that follows it, at rest.
struct SpineJoint {
  JointId parent;             ///< invalid at a root
  JointId next;               ///< the child in which the same limb goes on; invalid at a tip
  vec3 centre{0};             ///< [m]
  vec3 axis{0};               ///< unit direction of the link; zero where the joint has none
  float link = 0;             ///< [m] its length
  float arc = 0;              ///< [m] length of the arc over which the spine bends here
  bool spreadsTwist = false;  ///< turning about `axis` is spread along the link, not along the arc
  mat4 restInverse{1};        ///< model space -> joint space at rest
};

/// The spines of a body: one per limb, straight along the links and bending in an arc over each joint.
/// All places on all spines are addressed by a joint and how far its motion has set in there: see Station.
struct SpineSet {
  std::vector<SpineJoint> joints;           ///< one a joint of the skeleton, parents first
  std::vector<std::vector<JointId>> limbs;  ///< each from its stem (on another limb, or a root) to its tip
};

/// A place along a spine. From 0 to 1 it runs over the joint's arc: at 0 the place moves with the bone before
/// the joint, at 1 it has taken over the joint's bend. From 1 to 2 it runs along the link and takes over the
/// joint's twist; joints that do not spread their twist have it in the arc. At 2 it moves with the joint's
/// bone.
struct Station {
  JointId joint;
  float along = 2;
};

/// Derives the spines from the joints alone; names are not looked at. A limb goes on in the child that leads
/// straightest on, with some preference for the longer subtree. Twist is spread along every link that is not
/// much shorter than the one after it; arcs are 0 until set.
/// Fails with badInput: no joints, a rest transform that is not finite or not invertible.
/// @param name  of the body, for the message
Result<SpineSet> deriveSpines(const Skeleton& skeleton, std::string_view name);

/// What one pose does to every place on the spines.
///
/// A place's transform turns about the joint's centre by the share of the joint's rotation that has set in:
///   X(p) = c + s Q (p - centre),   Q = before · bend^φ · twist^ψ.
/// Along a limb X is a one-parameter family of similarities that starts as the bone before the joint and ends
/// as the bone after it, so a map p -> X(station(p)) p is as smooth as station(p), keeps distances to the
/// joint's centre, and with φ a smoothstep over an arc of length L it cannot fold nearer to the axis than R
/// as long as L >= 1.5 · angle · R. At rest every X is the identity.
class SpinePose {
 public:
  /// Sized once; run() does not allocate.
  explicit SpinePose(const SpineSet& spines);

  /// @param pose  one matrix a joint; uniform scale is followed, other scale by its mean. O(joints)
  void run(const SpineSet& spines, const Pose& pose);

  /// Where the rest point p goes when it is bound to a station.
  vec3 place(Station station, vec3 p) const;
  /// The joint's own part of that in rest space: p turned about the joint's centre by the share of the bend
  /// (along up to 1) or of the twist (along above 1) alone. What stations overlap at a place are chained
  /// with.
  vec3 turn(Station station, vec3 p) const;
  /// Rotation part of the station's transform: carries reference directions.
  quat rotation(Station station) const;
  quat turning(Station station) const;

  /// Where the joint's own bone takes a rest point.
  vec3 placeAfter(JointId joint, vec3 p) const;

 private:
  struct Motion {
    vec3 centre;                     // rest
    vec3 centreBefore, centreAfter;  // where the bones before and after take it
    quat before, after;
    float scaleBefore = 1, scaleAfter = 1;
    vec3 bendAxis, twistAxis;
    float halfBend = 0, halfTwist = 0;
  };
  std::vector<Motion> motions_;
};

/// Axis times angle [rad] of the shortest turn that takes the joint's link from rest to where a pose has it,
/// seen from the bone before it and in rest directions; at a tip, of the whole turn.
vec3 bendOf(const SpineSet& spines, const Pose& pose, JointId joint);

}  // namespace vasa
