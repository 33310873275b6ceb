// Light on tubes and meshes.
#ifndef VASA_OPAQUE
#define VASA_OPAQUE
#include "lib/shade.glsl"
#include "lib/view.glsl"

layout(location = 0) in vec3 normal;
layout(location = 1) flat in vec4 colour;
layout(location = 2) flat in float layer;
layout(location = 0) out vec4 pixel;

vec4 litPixel() {
  vec3 outward = normalize(gl_FrontFacing ? normal : -normal);
  return vec4(shade(colour.rgb, outward, eyeAt(gl_FragCoord.xy), worldUp()), 1);
}

#endif
