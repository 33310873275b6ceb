#pragma once
#include <vector>

#include "shared/growth.h"

// A curve as a ribbon of `edges` quads that faces the camera: the shared polyline with its thickness, and
// shared::kSoftEdge pixels more on both sides, over which it fades: so a thin curve covers a pixel by the
// share that it takes of it, wherever it lies between pixels, and nothing glitters in motion. It reaches
// half a radius beyond both ends, so that no wedge opens where branches part. What lies deep below the skin,
// as it is seen, is darker and fades. A curve thinner than a pixel is a thread: a ribbon of two edges, a
// leaf, which most curves are, one of one edge. In C++: tests/reference/ribbon.h.
namespace vasa {

/// Vertices and triangles of `copies` ribbons, one behind the other; of threads where edges are
/// shared::kThreads.
constexpr std::uint32_t ribbonVertices(std::uint32_t edges) {
  return edges == shared::kThreads ? shared::kThreadVertices : 2 * (edges + 1);
}
constexpr std::uint32_t ribbonTriangles(std::uint32_t edges) { return ribbonVertices(edges) - 2; }
std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies);

}  // namespace vasa
