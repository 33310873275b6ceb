#pragma once
#include <span>
#include <vector>

#include "shared/detail.h"
#include "surface/tessellate.h"

// The rule of surface/detail.h: CPU reference of shaders/measure.comp and around.comp.
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

/// Rings of a cap, the rim included: kCapRings, or of thin vessels with --quads auto the rim alone before the
/// pole. A cone in a half ball's place is off by 0.3 R at most.
std::uint32_t capRings(std::uint32_t around, const shared::DetailView& view);

/// m of every vessel (the least for one out of view) and n of every sweep (0: out of view).
struct NetworkDetail {
  std::vector<std::uint32_t> around, along;
};
NetworkDetail networkDetail(const PosedNetwork& network, const shared::DetailView& view);

}  // namespace vasa
