#pragma once
#include "growth/capillary.h"

namespace vasa {

/// A curve as a ribbon of `edges` quads (growth/ribbon.h). The CPU reference of shaders/capillary.comp.
/// @param root      colour of the vessel, sRGB, red lowest
/// @param vertices  2 · (edges + 1), the two sides by turns
void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t edges, std::span<shared::CapillaryVertex> vertices);

/// A curve thinner than a pixel as a ribbon of two edges; a leaf as one of one edge: its last two vertices
/// are those before them.
/// @param vertices  shared::kThreadVertices
void writeThread(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::span<shared::CapillaryVertex> vertices);

}  // namespace vasa
