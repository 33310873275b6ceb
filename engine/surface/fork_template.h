#pragma once
#include <vector>

#include "surface/fork.h"

namespace vasa {

/// Triangles of a fork (vertices: surface/fork.h), counter-clockwise seen from outside: the CPU reference of
/// shaders/lib/fork_triangles.glsl, in the same order. Each branch's: the wall about its hole and its collar,
/// or its stump; then the trunk's.
/// @param vertices  of the fork, posed: quads that would fold are cut along their other diagonal where that
///                  does not; none: all along the first, for a mesh that keeps its triangles in every pose
std::vector<uvec3> forkTriangles(const ForkShape& shape, const ForkLayout& layout,
                                 std::span<const SurfacePoint> vertices);
std::vector<uvec3> trunkTriangles(const ForkShape& shape, const ForkLayout& layout,
                                  std::span<const SurfacePoint> vertices);
std::vector<uvec3> branchTriangles(const ForkShape& shape, const ForkLayout& layout, std::uint32_t branch,
                                   std::span<const SurfacePoint> vertices);

/// A window's outline: its vertices from the middle of its right side on, counter-clockwise seen from
/// outside.
inline std::uint32_t outlineSize(const ForkWindow& window) { return 2 * window.count + 4; }
/// Row of the trunk, and column from the window's first one on.
uvec2 outlinePlace(const ForkWindow& window, std::uint32_t i);
std::uint32_t outlineVertex(const ForkShape& shape, const ForkWindow& window, std::uint32_t i);

/// How many without stumps, which have fewer than a window of one column. @param columns  of all windows
/// together
std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t columns);

}  // namespace vasa
