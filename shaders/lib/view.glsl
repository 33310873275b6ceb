// Where a pixel is seen from and what lies before the camera's cutting plane.
#ifndef VASA_VIEW
#define VASA_VIEW
#include "shared/draw.h"

layout(push_constant, std430) uniform Push { DrawPush push; };

// Samples a pixel where surfaces are partial, cut off or translucent; 0: all are whole.
layout(constant_id = 1) const uint kPartial = 0;

vec3 eyeAt(vec2 pixel) { return normalize(vec3(push.eyeCorner + pixel * vec2(-push.eyeStep, push.eyeStep), 1)); }

vec3 worldUp() {
  vec4 q = push.turn;
  return vec3(2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x));
}

bool cutOff(vec4 fragment) { return kPartial != 0 && dot(push.cut, vec4(fragment.xyz, 1)) < 0; }

// Samples of the pixel that a translucent surface covers: as many as its opacity asks for, the rest by a pattern over
// pixels (interleaved gradient noise, Jimenez 2014). So it needs no order of drawing and blends with nothing. Every layer
// has another pattern, or one would hide behind another of the same opacity altogether.
int coveredSamples(vec2 pixel, float opacity, float layer) {
  float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))) + 0.618034 * layer);
  uint count = uint(clamp(floor(opacity * float(kPartial) + noise), 0.0, float(kPartial)));
  uint all = (1u << kPartial) - 1u, some = (1u << count) - 1u, turn = uint(layer) % kPartial;
  return int((some << turn | some >> (kPartial - turn)) & all);
}

#endif
