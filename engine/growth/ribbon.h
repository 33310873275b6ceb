#pragma once
#include "growth/capillary.h"

namespace vasa {

/// A curve as a ribbon of `edges` quads that faces the camera: the shared polyline with its thickness. Where it is
/// thinner than view.thinnest pixels it is drawn that wide and fades as much instead. It reaches half a radius beyond
/// both ends, so that no wedge opens where branches part; a leaf ends in a point.
/// The CPU reference of shaders/capillary.comp.
/// @param root      colour of the vessel, sRGB, red lowest
/// @param far       of the partner's vessel, for curves that are joined
/// @param vertices  2 · (edges + 1), the two sides by turns
void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root, std::uint32_t far, std::uint32_t edges,
                 std::span<shared::CapillaryVertex> vertices);

/// Pairs of triangles of `copies` ribbons, one behind the other.
std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies);

}  // namespace vasa
