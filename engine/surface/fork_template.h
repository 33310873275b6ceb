#pragma once
#include <vector>

#include "surface/fork.h"

namespace vasa {

/// Triangles of a fork (vertices: surface/fork.h), counter-clockwise seen from outside: the CPU reference of
/// shaders/lib/fork_triangles.glsl, in the same order.
/// @param window  columns that the hole takes (forkWindow); 0: no branch
std::vector<uvec3> forkTriangles(const ForkShape& shape, std::uint32_t window);

/// How many.
std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t window);

}  // namespace vasa
