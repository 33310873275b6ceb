// Read by C++ and GLSL (std430): ambient occlusion from the picture's depth.
#ifndef VASA_SHARED_OCCLUSION_H
#define VASA_SHARED_OCCLUSION_H
#include "shared/language.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Points that are looked at around a pixel: a golden-angle spiral in the unit disc, turned from pixel to
/// pixel in a pattern of kOcclusionTile x kOcclusionTile, which smooth.frag takes the mean of.
VASA_CONSTANT uint kOcclusionTaps = 12, kOcclusionTile = 4;
VASA_CONSTANT vec2 kOcclusionSpiral[kOcclusionTaps] = {
    vec2(0.092223f, 0.000000f),  vec2(-0.155013f, 0.142004f),  vec2(0.026959f, -0.307187f),
    vec2(0.241481f, 0.314968f),  vec2(-0.471882f, -0.083469f), vec2(0.470005f, -0.298979f),
    vec2(-0.163911f, 0.609745f), vec2(-0.323985f, -0.623811f), vec2(0.725258f, 0.264862f),
    vec2(-0.775784f, 0.320234f), vec2(0.383453f, -0.819421f),  vec2(0.289884f, 0.924188f)};

/// Of occlusion.frag and smooth.frag. A pixel's place in the camera's axes: its distance before the eye
/// (fromDepth.x + fromDepth.y d) / (fromDepth.z + fromDepth.w d), and (corner + pixel * step) times that
/// distance in perspective, times 1 orthographically.
struct OcclusionPush {
  vec4 fromDepth;
  uint width, height;
  vec2 corner, step;
  float perspective;  // 1, or 0 orthographic
  float reach;        // [m] how far away a surface takes light
  float strength;
};

#ifdef __cplusplus
static_assert(sizeof(OcclusionPush) == 52);
}  // namespace vasa::shared
#endif
#endif
