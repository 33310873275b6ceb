// Read by C++ and GLSL (std430): what a frame's picture asks of the network's tessellation.
#ifndef VASA_SHARED_DETAIL_H
#define VASA_SHARED_DETAIL_H
#include "shared/sweep.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Quads around a vessel whose m the picture decides: for one no thicker than its tolerance, and least for
/// any other. From kCoarse [pixels] on, for pictures that move, a tolerance asks for still fewer than
/// kRoundAround where that takes kThinShare of it: few corners also make a vessel thinner.
VASA_CONSTANT uint kThinAround = 5, kRoundAround = 8;
VASA_CONSTANT float kCoarse = 0.5, kThinShare = 0.25;
/// Share of the tolerance that corners along a sweep may take: they show sooner than those around it.
VASA_CONSTANT float kAlongShare = 0.07;

/// A picture's view of the network. Fixed m and n, or those that keep an error in pixels.
struct DetailView {
  vec4 picture[3];  // (dot(picture[0], q), dot(picture[1], q)) / dot(picture[2], q), q = (p, 1): p's place
                    // [pixels]
  vec4 planes[5];   // left, right, bottom, top, near: dot(plane.xyz, p) + plane.w >= 0 in view; unit normals
  vec4 depth;     // dot(depth.xyz, p) + depth.w: how far p lies before the eye [m]; (0, 0, 0, 1) orthographic
  float nearest;  // [m] least depth that counts; 1 orthographic
  float reach;    // share of a ball's radius that comes nearer: 1, or 0 orthographic
  float focal;    // pixels a metre at depth 1
  float tolerance;       // [pixels] between a sweep and its quads; used where around or along is 0
  uint around, along;    // m and n of all sweeps; 0: by tolerance
  uint hiddenKinds;      // bit k: sweeps of kind k (highest 8 bits of their colour) are not drawn
  float columns, rows;   // pixels of the picture, whose middles lie at whole numbers
  float snap;            // [pixels] how far a rasteriser may move a corner
  uint samples, unused;  // a pixel: 1 or 4
};

#ifdef __cplusplus
static_assert(sizeof(DetailView) == 48 + 80 + 16 + 48 && offsetof(DetailView, rows) == 22 * 8);
}  // namespace vasa::shared
#endif
#endif
