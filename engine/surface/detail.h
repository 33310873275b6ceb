#pragma once
#include <cstdint>
#include <span>

#include "math/types.h"

// How finely a network is cut for one picture. The rule on which everything that meets a ring relies:
//
//   m, the quads around, belongs to a vessel: all its rings have the same m, so neighbouring spans share
//   their ring
//     to the bit, whatever their n. What joins several vessels (a fork) takes each ring with its own vessel's
//     m.
//   n, the quads along, belongs to a sweep, as a ring at its end does not depend on it.
//
// With fixed quads both are the same everywhere; a sweep out of view has n = 0 and is not tessellated. With
// --quads auto they follow from DetailView::tolerance:
//   m = kThinAround where R <= tolerance, else the least m >= kRoundAround with
//     R (1 − cos(π/m)) <= tolerance; from
//     tolerance = kCoarse on, the least m with that, or with kThinShare · tolerance where m < kRoundAround
//     R: largest radius of the vessel's sweeps in view [pixels]
//   n = the least n with E / n² <= kAlongShare · tolerance
//     E: height of an arc as bent as the sweep's most bent part, at its outer side [pixels]
// up to kMaxAround and kMaxAlong. The rule in C++: tests/reference/detail.h.
namespace vasa {

/// Where a picture is sampled.
struct PictureGrid {
  vec2 size;                  ///< [pixels]
  float snap = 0;             ///< [pixels] how far a rasteriser may move a corner in each coordinate
  std::uint32_t samples = 1;  ///< a pixel: 1 in its middle, or 4 at Vulkan's standard places
};

/// (1 − cos(π/m)) for m = 0 .. kMaxAround (m < 3 unused), as the shaders read it.
std::span<const float> aroundErrors();

}  // namespace vasa
