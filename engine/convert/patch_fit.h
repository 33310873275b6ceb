#pragma once
#include "convert/fork_openings.h"
#include "network/fork_patch.h"

namespace vasa {

/// What carries a piece of wall between the rings of a fork: beside a ring the wall is eased into the tube's
/// round section. How much a vertex moves with each ring is the solution of Laplace's equation on the wall, 1
/// on that ring's loop and 0 on the others. What folds is smoothed (convert/unfold.h).
/// @param wall  cut out along the openings, without a fault
/// @return a patch without rings where the wall is far from the tubes there
ForkPatch fitPatch(std::span<const ForkOpening> openings, WallPiece wall);

}  // namespace vasa
