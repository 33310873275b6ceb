#pragma once
#include <functional>

#include "body/skin_shell.h"
#include "math/similarity.h"

namespace vasa {

/// How the surface of a person, or of a part of one (a torso), lies in a body's skin.
struct SurfaceFit {
  Similarity by;       ///< from the surface's space to the body's
  float share = 0;     ///< of the surface's vertices that lie near the skin then, facing as it does
  float distance = 0;  ///< [m] of these from it, in the mean
  float cost = 0;  ///< about the share of the surface that is elsewhere, and of what contradicts the place
};

/// Finds it by shape alone. The surface must stand upright, head up, in metres; where it stands and which way
/// it faces does not matter, but where front and back look alike it is taken to face +Z.
/// Method: from four facings, places all over the skin's box and five sizes, iterated nearest points that
/// face alike (Besl and McKay 1992), by similarities; the best of these again with more points. Sizes beyond
/// 0.5 to 2 times its own are hardly found. Deterministic, for any number of threads.
/// @param surface    outward, one vertex a place
/// @param misplaced  what else tells where it belongs: the share, 0 to 1, of what a place contradicts
SurfaceFit fitSurface(const TriangleMesh& surface, const SkinShell& skin,
                      const std::function<float(const Similarity&)>& misplaced = {});

/// Below this share a fit is none.
constexpr float kLeastSurfaceShare = 0.6f;

}  // namespace vasa
