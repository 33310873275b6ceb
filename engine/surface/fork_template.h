#pragma once
#include <vector>

#include "surface/fork.h"

namespace vasa {

/// Triangles of a fork (vertices: surface/fork.h), counter-clockwise seen from outside: the CPU reference of
/// shaders/lib/fork_triangles.glsl, in the same order. Each branch's: the wall about its hole and its collar, or
/// its stump; then the trunk's.
std::vector<uvec3> forkTriangles(const ForkShape& shape, const ForkLayout& layout);
std::vector<uvec3> trunkTriangles(const ForkShape& shape, const ForkLayout& layout);
std::vector<uvec3> branchTriangles(const ForkShape& shape, const ForkLayout& layout, std::uint32_t branch);

/// How many without stumps, which have fewer than a window of one column. @param columns  of all windows together
std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t columns);

}  // namespace vasa
