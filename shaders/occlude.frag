#version 460
// Takes occlusion off what is drawn; blended by multiplication.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/occlusion.h"

layout(push_constant, scalar) uniform Push { OcclusionPush push; };
layout(location = 0) out vec4 pixel;

void main() {
  uint at = uint(gl_FragCoord.y) * push.width + uint(gl_FragCoord.x);
  // What little light comes out of a crease has met its colour often: less is lost of red than of blue.
  float light = push.raw.value[at];
  pixel = vec4(pow(vec3(light), vec3(0.92, 1.02, 1.06)), 1);
}
