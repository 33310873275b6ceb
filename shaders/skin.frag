#version 460
// A thin translucent shell: more to be seen at the outline, where the line of sight runs along the skin.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/shade.glsl"
#include "shared/draw.h"

layout(push_constant, scalar) uniform Push { DrawPush push; };
layout(location = 0) in vec3 normal;
layout(location = 1) flat in vec3 colour;
layout(location = 0) out vec4 pixel;  // premultiplied

void main() {
  vec3 eye = normalize(vec3(push.eyeCorner + gl_FragCoord.xy * push.eyeStep, 1));
  vec3 worldUp = vec3(push.right.y, push.up.y, push.right.z * push.up.x - push.right.x * push.up.z);
  vec3 outward = normalize(normal);
  float graze = 1 - clamp(dot(outward, eye), 0.0, 1.0);
  float alpha = clamp(push.opacity * (0.7 + 2.0 * graze * graze * graze), 0.0, 1.0);
  vec3 light = mix(kGround, kSky, 0.5 + 0.5 * dot(outward, worldUp)) + 0.45 * wrapped(dot(outward, kKey));
  pixel = vec4((colour * light + 0.3 * kKeyColour * highlight(outward, eye, kKey)) * alpha, alpha);
}
