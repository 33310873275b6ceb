#pragma once
#include "surface/detail.h"

namespace vasa {

/// Which triangles of a quad may cover a sample of the picture with their fronts: bit 0 for (a, b, c), bit 1
/// for (a, c, d). A bit is left out only if the triangle certainly covers none, however the rasteriser moves
/// its corners, so not drawing it changes no pixel; both are kept where the quad's box is wide enough. CPU
/// reference of shaders/lib/visible.glsl; near a margin the two may differ.
/// @param a, b, c, d  places on the picture [pixels], counter-clockwise seen from outside, y down: the middle
/// of pixel k
///                    lies at k; kBehind (shared/tubes.h) in both coordinates for a corner before the near
///                    plane
std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, const PictureGrid& grid);

}  // namespace vasa
