#pragma once
#include "convert/element.h"

namespace vasa {

/// Joins branches of separate pieces whose free ends face one another across a tear: each end lies ahead of
/// the other, within `bridgeRadii` of the thicker one's radii (or `detail`, where that is more), their
/// directions oppose, and neither is more than twice as thick. Nearest pairs first; an end is used once; what
/// is connected already is left alone. Two branches become one, their nodes go. Returns the number of gaps
/// closed.
std::uint32_t bridgeGaps(ElementSkeleton& skeleton, float bridgeRadii, float detail);

/// Removes nodes of no branch, and renumbers.
void dropUnusedNodes(ElementSkeleton& skeleton);

}  // namespace vasa
