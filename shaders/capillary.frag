#version 460
// A ribbon lit as the round vessel it stands for; in x-ray, light that adds up.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#include "lib/shade.glsl"
#include "shared/draw.h"

layout(push_constant, std430) uniform Push { DrawPush push; };
#include "lib/view.glsl"
layout(location = 0) in vec4 tint;
layout(location = 1) in vec2 side;
layout(location = 0) out vec4 pixel;  // premultiplied

const float kXrayCapillaries = 0.55;

void main() {
  if (cutOff(gl_FragCoord)) discard;
  if (kStyle == 2) {
    pixel = vec4(tint.rgb, 1) * (tint.a * push.opacity * kXrayCapillaries);
    return;
  }
  vec3 eye = eyeAt(gl_FragCoord.xy);
  vec2 round = side * (tint.a * tint.a);  // thinner than a pixel: lit as if it faced the eye, or its edges glitter
  vec3 normal = normalize(vec3(round, 0) + sqrt(max(1 - dot(round, round), 0.0)) * eye);
  pixel = vec4(shade(tint.rgb, normal, eye, worldUp()), 1) * (tint.a * push.opacity);
}
