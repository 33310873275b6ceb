#pragma once
#include "body/body.h"

namespace vasa {

/// Tells a body's vertebrae, discs and ribs apart, each with a motion of its own (Body::axialBones).
///
/// Rigs bend the 24 joints of a spine at four to seven, so that the vertebrae between them move as rigid
/// blocks. Flesh and vessels do not: they bend over an arc (body/binding.h). What passes from one block to
/// the next, as the vertebral artery in its canal, would be sheared by as much as the flesh is ahead of the
/// bone, and two ribs at a block's edge close on what runs between them. So each vertebra turns about its
/// rig's joints by the share that a vessel in its middle does (`Binding::axialBones`), and a rib hangs on its
/// vertebra by the head while its front end goes where the flesh there does, or with the breastbone's
/// cartilage that it is joined to (Deformer::axialBones).
///
/// A vertebra is a part of a rigid mesh that hangs together, carried wholly by one joint between hips and
/// head, through whose box the line through these joints passes, and shorter than the longest way between two
/// of them. A rib is another such part, beside that line and joined to up to four of them. Where one is
/// joined to more, as a cage in one piece, those and what lies between them keep to their blocks. Nothing is
/// done where it is not known which joints hips and head are. O(vertices · log vertices)
///
///   separateAxialBones(body);            // before vessels are bound to it
///   deformer.axialBones(body, matrices);  // where they are, in the pose of its last run
void separateAxialBones(Body& body);

}  // namespace vasa
