#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/shade.glsl"
#include "shared/draw.h"

layout(push_constant, scalar) uniform Push { DrawPush push; };
layout(location = 0) in vec3 normal;
layout(location = 1) flat in vec3 colour;
layout(location = 0) out vec4 pixel;

void main() {
  vec3 eye = normalize(vec3(push.eyeCorner + gl_FragCoord.xy * push.eyeStep, 1));
  vec3 worldUp = vec3(push.right.y, push.up.y, push.right.z * push.up.x - push.right.x * push.up.z);
  vec3 outward = normalize(gl_FrontFacing ? normal : -normal);
  pixel = vec4(shade(colour, outward, eye, worldUp), 1);
}
