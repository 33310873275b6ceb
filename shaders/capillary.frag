#version 460
// A ribbon lit as the round vessel it stands for; in x-ray, light that adds up. It fades towards its edges over a fixed
// number of pixels: the share of the pixel that the curve covers, wherever it lies between pixels.
#extension GL_GOOGLE_include_directive : require
#include "lib/shade.glsl"
#include "lib/view.glsl"

layout(location = 0) in vec4 tint;
layout(location = 1) in vec3 side;
layout(location = 0) out vec4 pixel;  // premultiplied

const float kXrayCapillaries = 0.55;

void main() {
  float perPixel = length(vec2(dFdx(side.z), dFdy(side.z)));
  if (cutOff(gl_FragCoord)) discard;
  float opacity = tint.a * push.opacity * clamp((1 - abs(side.z)) / (2 * kSoftEdge * perPixel), 0.0, 1.0);
  if (kStyle == 2) {
    pixel = vec4(tint.rgb, 1) * (opacity * kXrayCapillaries);
    return;
  }
  vec3 eye = eyeAt(gl_FragCoord.xy);
  vec3 normal = normalize(vec3(side.xy, 0) + sqrt(max(1 - dot(side.xy, side.xy), 0.0)) * eye);
  pixel = vec4(shade(tint.rgb, normal, eye, worldUp()), 1) * opacity;
}
