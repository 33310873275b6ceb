#pragma once
#include "body/body.h"

namespace vasa {

/// Tells a body's vertebrae and discs apart, each with a motion of its own (Body::vertebrae).
///
/// Rigs bend the 24 joints of a spine at four to seven, so that the vertebrae between them move as rigid
/// blocks. Flesh and vessels do not: they bend over an arc (body/binding.h). What passes from one block to
/// the next, as the vertebral artery in its canal, would be sheared by as much as the flesh is ahead of the
/// bone. So each vertebra turns about its rig's joints by the share that a vessel in its middle does:
/// `Binding::vertebrae`.
///
/// A vertebra is a part of a rigid mesh that hangs together, carried wholly by one joint between hips and
/// head, through whose box the line through these joints passes, and shorter than that joint's link. Those
/// to which ribs are joined, and what lies between them, keep to their blocks with the ribs: necks and loins
/// are left. Nothing is done where it is not known which joints hips and head are. O(vertices · log vertices)
///
///   separateVertebrae(body);      // before vessels are bound to it
///   deformer.vertebrae(motions);  // where they are, in the pose of its last run
void separateVertebrae(Body& body);

}  // namespace vasa
