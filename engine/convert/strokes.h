#pragma once
#include "convert/element.h"
#include "convert/strand.h"

namespace vasa {

/// Adds an element's skeleton to the graph: at every fork the two branches that continue one another best
/// (straightness, then likeness of radius) become one strand, and the others hang on its side; where no two
/// continue within a right angle all of them just meet. So a trunk with twigs is one smooth vessel with side
/// branches, not a chain of pieces. A strand never meets itself on its own side: a loop is opened at a fork.
/// @return the new strands, longest first
std::vector<std::uint32_t> addSkeleton(StrandGraph& graph, const ElementSkeleton& skeleton,
                                       std::uint32_t element, VesselKind kind);

}  // namespace vasa
