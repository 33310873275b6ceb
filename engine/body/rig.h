#pragma once
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/humanoid.h"
#include "body/motion_rest.h"
#include "body/skeleton.h"
#include "core/ids.h"
#include "math/direction.h"

namespace vasa {

inline const quat kIdentity(1, 0, 0, 0);

/// What a body's skeleton and a motion's have in common: joints with names, parents and places, and what part
/// of a person each is.
struct Rig {
  std::vector<std::string> names;
  std::vector<std::uint32_t> parents;  ///< kNone at a root
  std::vector<vec3> centres, tips;     ///< a tip's end where the file has one, else the centre
  HumanoidNames parts;                 ///< by name; where names tell little, by the skeleton's shape

  /// kNone where there is none.
  std::uint32_t partNamed(std::string_view part) const { return vasa::partNamed(parts.of, part); }
  /// The joint at which the bone of an arm's or a leg's part ends; kNone for other parts.
  std::uint32_t limbEnd(std::string_view part) const;
  /// Where the bone of a joint that is this part ends: at that joint, or at its own tip where a skeleton ends
  /// with a forearm or a shin; nothing where neither is there.
  /// @param places, ends  of joints and tips, in any pose
  std::optional<vec3> boneEnd(std::uint32_t joint, std::string_view part, std::span<const vec3> places,
                              std::span<const vec3> ends) const;
};

/// A forearm or a shin.
bool isLowerBone(std::string_view part);

Rig rigOf(const Skeleton& skeleton);  ///< at rest
/// How many of a skeleton's trees, or of those below one node above all, are a person's by themselves: hips
/// and neck or head among their joints, and most of the limbs. Motions and vessels know of one.
/// 0 beyond 2000 joints.
std::size_t peopleIn(const Skeleton& skeleton);
std::size_t peopleMoved(const Motion& motion);  ///< likewise, in the first frame
/// In the first frame: a zero pose may have all bones along one line.
Rig rigOf(const Motion& motion);
/// Moves a motion's rig to one of its poses.
void placeIn(Rig& rig, const MotionPose& pose);

/// Left, up and forward of a trunk: up from the hips, left as these pairs of joints lie. Nothing where joints
/// are missing.
/// @param pairs  parts without their side, as "UpperArm"
std::optional<mat3> trunkOf(const Rig& rig, std::initializer_list<std::string_view> pairs);

/// Whether feet point backwards for what is called left and right: sides as somebody sees them who stands
/// before the person. False where nothing tells.
bool sidesSwapped(const Rig& rig);

/// Thighs and shins of both legs together [m], or in the motion's unit; 0 where one is missing.
float legsOf(const Rig& rig);
/// Height of all joints and tips.
float extentOf(const Rig& rig);

/// The share of what must hold between the parts of a person that does: lower bones behind upper ones, both
/// sides alike, legs away from the trunk. Names alone may mean anything.
float plausibility(const Rig& rig);

}  // namespace vasa
