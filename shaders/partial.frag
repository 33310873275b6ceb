#version 460
// As opaque.frag where something is cut off or translucent.
#extension GL_GOOGLE_include_directive : require
#include "lib/opaque.glsl"

void main() {
  int covered = coveredSamples(gl_FragCoord.xy, colour.a, layer);
  if (covered == 0 || cutOff(gl_FragCoord)) discard;
  gl_SampleMask[0] = covered;
  pixel = litPixel();
}
