#pragma once
#include "body/clip.h"

namespace vasa {

constexpr float kFarthestReach = 1000;  ///< [m]

/// Whether a clip takes no joint farther than that from where its root is at rest: beyond, numbers of 32 bits
/// no longer tell thin vessels apart, and at last they are none. Told by the longest ways that tracks let
/// each link have, whatever their rotations: O(keys + joints).
bool staysNear(const Skeleton& skeleton, const Clip& clip);

}  // namespace vasa
