#pragma once
#include <span>
#include <vector>

#include "math/types.h"
#include "shared/occlusion.h"

namespace vasa {

/// Ambient occlusion of a picture from its depth: the share of ambient light that is left at each pixel.
/// CPU references of shaders/occlusion.frag and smooth.frag.
/// @param depth  reversed, 0: background; row after row
std::vector<float> occlusionOf(std::span<const float> depth, const shared::OcclusionPush& constants);
std::vector<float> smoothed(std::span<const float> depth, std::span<const float> raw,
                            const shared::OcclusionPush& constants);

}  // namespace vasa
