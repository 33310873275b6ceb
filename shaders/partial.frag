#version 460
// As opaque.frag where something is cut off or translucent.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#include "shared/draw.h"

layout(push_constant, std430) uniform Push { DrawPush push; };
#include "lib/opaque.glsl"

void main() {
  int covered = coveredSamples(gl_FragCoord.xy, colour.a, layer);
  if (covered == 0 || cutOff(gl_FragCoord)) discard;
  gl_SampleMask[0] = covered;
  pixel = litPixel();
}
