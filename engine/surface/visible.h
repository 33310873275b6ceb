#pragma once
#include <cstdint>

#include "math/types.h"

namespace vasa {

/// Which triangles of a quad may cover a sample of the picture with their fronts: bit 0 for (a, b, c), bit 1 for
/// (a, c, d). A bit is left out only if the triangle certainly covers none, however the rasteriser rounds its corners
/// (by `snap` at most), so not drawing it changes no pixel. CPU reference of shaders/lib/visible.glsl; near a margin the
/// two may differ.
/// @param a, b, c, d  places on the picture, counter-clockwise seen from outside, y down, in samples: sample k lies at k;
///                    kBehind (shared/tubes.h) in both coordinates for a corner before the near plane
/// @param samples     columns and rows of samples
std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap);

}  // namespace vasa
