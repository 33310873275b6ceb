#version 460
// Depth alone, of what the cutting plane leaves.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#include "shared/draw.h"

layout(push_constant, std430) uniform Push { DrawPush push; };
#include "lib/view.glsl"

void main() {
  if (cutOff(gl_FragCoord)) discard;
}
