#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "body/body.h"

namespace vasa {

/// Clothes and hair often come on a skeleton of their own, a copy of the body's or a part of it, which
/// motions would leave behind. A joint that bears the name of an earlier one of another skin and tree (but
/// for numbers; a name that few have), and rests as that does, becomes that one: what it moves, what hangs on
/// it and its tracks, where the clip has none for the earlier one. O(joints · log joints + vertices)
/// @param body  as read: names not told apart yet
/// @param skins  one a joint: the first skin that it is a joint of, or kNone
/// @return of each joint the one that it is now
std::vector<JointId> uniteCopiedJoints(Body& body, std::span<const std::uint32_t> skins);

}  // namespace vasa
