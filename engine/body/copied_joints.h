#pragma once
#include <cstddef>

#include "body/body.h"

namespace vasa {

/// Clothes and hair often come on a skeleton of their own, a copy of the body's or a part of it, which
/// motions would leave behind. A joint that bears the name of an earlier one of another tree (but for
/// numbers), and rests as that does, becomes that one: what it moves, what hangs on it and its tracks, where
/// the clip has none for the earlier one. O(joints · log joints + vertices)
/// @param body  as read: names not told apart yet
/// @return how many joints were copies
std::size_t uniteCopiedJoints(Body& body);

}  // namespace vasa
