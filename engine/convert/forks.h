#pragma once
#include "convert/axes.h"
#include "mesh/triangle_tree.h"

namespace vasa {

/// Settles where the forks lie and brings every branch to them. The two branches at a fork that run on most
/// straightly carry its node on a smooth curve between them, at the place the others point to; the others go
/// there on a curve that leaves them straight. On the way they fill the lumen that they share: their radius
/// is the distance to the surface where that is more than their own, up to that of the widest branch at the
/// fork. Chains that meet at a node all get a section exactly on it.
/// @param sections  one list a chain, in the chain's direction; trimmed clear of the forks; may be empty,
/// then a
///                  straight piece with the rough chain's median radius is made
/// @param surface  of the piece
void connectForks(AxisGraph& graph, std::vector<std::vector<vec4>>& sections, const TriangleTree& surface);

}  // namespace vasa
