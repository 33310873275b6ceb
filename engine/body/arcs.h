#pragma once
#include <span>

#include "body/bone_field.h"

namespace vasa {

/// Chooses the arc length of every joint and where twist is spread (SpineJoint::arc, spreadsTwist).
///
/// An arc is max(1.8 · angle · R, 2 R tan(angle / 2)) long: vessels within R neither fold in it nor run into
/// one another beyond its ends. The angle is the joint's largest bend in the body's clips (100° without
/// clips), from 40° to 150°; R is the distance from the link, in the plane of that bend or half of it in any
/// direction, within which 95 % of the points around the joint lie. No arc is shorter than 1.2 % of the body
/// height or 0.4 of the shorter link at the joint. No arc is longer than 0.45 of the way to a neighbouring
/// joint that moves and is 4/3 R away or more (R: the larger of both joints'); a nearer one limits it less,
/// one within R not at all. Vessels farther out than arc / (1.8 · angle) fold there on the inside of the
/// largest bend. Arcs may overlap; their bends then add up. Where there are bones, a joint spreads its twist
/// along its link only if a bone of the joints before it runs beside that link (the ulna beside the radius);
/// elsewhere the flesh turns with the bone.
/// @param points  to be bound [m]
void chooseArcs(SpineSet& spines, const Body& body, const BoneField& bones, std::span<const vec4> points);

/// For one point: the distance to each joint's subtree (behind) and to its ancestors (before) [m], from the
/// distances to each joint's own bones.
void distancesAcrossJoints(const SpineSet& spines, std::span<const float> own, std::span<float> behind,
                           std::span<float> before);

}  // namespace vasa
