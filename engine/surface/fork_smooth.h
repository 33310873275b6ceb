#pragma once
#include "surface/fork.h"

namespace vasa {

// A step of smoothing moves a part's inner vertices towards the mean of their four neighbours, and turns its
// normals towards those of the surface that comes of it. Folds are sharp, so that they go first; a part that
// a pose folds but little changes but little. Vertices of the tubes' rings stay. Mirrored by
// shaders/lib/fork_smooth.glsl.

/// Of the trunk's rows.
void smoothTrunk(const ForkShape& shape, std::span<SurfacePoint> vertices);

/// Of a branch's collar and its hole.
void smoothCollar(const ForkShape& shape, const ForkLayout& layout, std::uint32_t branch,
                  std::span<SurfacePoint> vertices);

/// All parts of a fork, as often as its layout says.
void smoothParts(const ForkShape& shape, const ForkLayout& layout, std::span<SurfacePoint> vertices);

}  // namespace vasa
