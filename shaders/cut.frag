#version 460
// Depth alone, of what the cutting plane leaves.
#extension GL_GOOGLE_include_directive : require
#include "lib/view.glsl"

void main() {
  if (cutOff(gl_FragCoord)) discard;
}
