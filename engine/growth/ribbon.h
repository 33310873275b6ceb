#pragma once
#include "growth/capillary.h"

namespace vasa {

/// A curve as a ribbon of `edges` quads that faces the camera: the shared polyline with its thickness. Where
/// it is thinner than view.thinnest pixels it is drawn that wide and fades as much instead. It reaches half a
/// radius beyond both ends, so that no wedge opens where branches part; a leaf ends in a point. The CPU
/// reference of shaders/capillary.comp.
/// @param root      colour of the vessel, sRGB, red lowest
/// @param far       of the partner's vessel, for curves that are joined
/// @param vertices  2 · (edges + 1), the two sides by turns
void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t far, std::uint32_t edges, std::span<shared::CapillaryVertex> vertices);

/// A curve thinner than a pixel as a strip of four triangles where its ribbon of three edges has six: the
/// vertices in between lie on the right and left of the curve by turns. Leaves, which most curves are, have
/// two of them: their ends come to points, and they fade as much less.
/// @param vertices  shared::kThreadVertices
void writeThread(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t far, std::span<shared::CapillaryVertex> vertices);

/// Vertices and triangles of `copies` ribbons, one behind the other; of threads where edges are
/// shared::kThreads.
constexpr std::uint32_t ribbonVertices(std::uint32_t edges) {
  return edges == shared::kThreads ? shared::kThreadVertices : 2 * (edges + 1);
}
constexpr std::uint32_t ribbonTriangles(std::uint32_t edges) { return ribbonVertices(edges) - 2; }
std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies);

}  // namespace vasa
