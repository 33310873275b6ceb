#pragma once
#include "convert/axes.h"

namespace vasa {

/// Settles where the forks lie and brings every branch to them. The two branches at a fork that run on most
/// straightly carry its node on a smooth curve between them, at the place the others point to; the others go
/// there on a curve that leaves them straight, with their own radii. Chains that meet at a node all get a
/// section exactly on it.
/// @param sections  one list a chain, in the chain's direction; trimmed clear of the forks; may be empty,
/// then a
///                  straight piece with the rough chain's median radius is made
void connectForks(AxisGraph& graph, std::vector<std::vector<vec4>>& sections);

}  // namespace vasa
