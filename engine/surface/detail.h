#pragma once
#include <span>
#include <vector>

#include "shared/detail.h"
#include "surface/tessellate.h"

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
// up to kMaxAround and kMaxAlong. CPU reference of shaders/measure.comp and around.comp.
namespace vasa {

/// What a sweep is in a picture.
struct SweepExtent {
  bool inView = false;     ///< its hull is not wholly outside one side of the picture
  float radiusPixels = 0;  ///< R: of the largest de Boor radius at the nearest depth
  float bendPixels = 0;    ///< E
};
/// @param points  the span's four de Boor points. The tube and its round ends lie in the hull of their balls.
SweepExtent sweepExtent(std::span<const vec4, 4> points, const Bezier& bezier,
                        const shared::DetailView& view);

/// Least m and n for an error in pixels.
std::uint32_t aroundFor(float radiusPixels, float tolerance);
std::uint32_t alongFor(float bendPixels, float tolerance);

/// (1 − cos(π/m)) for m = 0 .. kMaxAround (m < 3 unused), as the shaders read it.
std::span<const float> aroundErrors();

/// Rings of a cap, the rim included: kCapRings, or of thin vessels with --quads auto the rim alone before the
/// pole. A cone in a half ball's place is off by 0.3 R at most.
std::uint32_t capRings(std::uint32_t around, const shared::DetailView& view);

/// m of every vessel (the least for one out of view) and n of every sweep (0: out of view).
struct NetworkDetail {
  std::vector<std::uint32_t> around, along;
};
NetworkDetail networkDetail(const PosedNetwork& network, const shared::DetailView& view);

}  // namespace vasa
