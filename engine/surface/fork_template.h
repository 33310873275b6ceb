#pragma once
#include <vector>

#include "surface/fork.h"

namespace vasa {

/// Triangles of a fork (vertices: surface/fork.h), counter-clockwise seen from outside: the CPU reference of
/// shaders/lib/fork_triangles.glsl, in the same order.
/// @param windows  one a branch (ForkLayout::window)
std::vector<uvec3> forkTriangles(const ForkShape& shape, std::span<const ForkWindow> windows);

/// How many. @param columns  of all windows together
std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t columns);

}  // namespace vasa
