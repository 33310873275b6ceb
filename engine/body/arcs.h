#pragma once
#include <span>

#include "body/bone_field.h"

namespace vasa {

/// Chooses the arc length of every joint and where twist is spread (SpineJoint::arc, spreadsTwist).
///
/// An arc is 1.5 · angle · R long: angle is the joint's largest bend in the body's clips with a tenth to
/// spare, R the distance from the link within which nine in ten of the points around the joint lie. Where
/// there are bones, a joint spreads its twist along its link only if a bone of the joints before it runs
/// beside that link (the ulna beside the radius); elsewhere the flesh turns with the bone.
/// @param points  to be bound [m]
void chooseArcs(SpineSet& spines, const Body& body, const BoneField& bones, std::span<const vec4> points);

/// For one point: the distance to each joint's subtree (behind) and to its ancestors (before) [m], from the
/// distances to each joint's own bones.
void distancesAcrossJoints(const SpineSet& spines, std::span<const float> own, std::span<float> behind,
                           std::span<float> before);

}  // namespace vasa
