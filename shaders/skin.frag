#version 460
// A thin translucent shell: more of it is in the line of sight at the outline, so that vessels read through its middle.
#extension GL_GOOGLE_include_directive : require
#include "lib/shade.glsl"
#include "lib/view.glsl"

layout(location = 0) in vec3 normal;
layout(location = 1) flat in vec4 colour;
layout(location = 0) out vec4 pixel;  // premultiplied

void main() {
  if (cutOff(gl_FragCoord)) discard;
  vec3 eye = eyeAt(gl_FragCoord.xy);
  vec3 outward = normalize(normal);
  // Where a pose stretches a fold, smooth normals lean away from a surface that is seen: that is no outline.
  float graze = 1 - min(abs(dot(outward, eye)), 1.0);
  float alpha = clamp(push.opacity * (0.45 + 2.6 * graze * graze * graze), 0.0, 1.0);
  vec3 gloss = kStyles[kStyle].key * (3.0 * highlight(outward, eye, kKey));
  vec3 light = ambientLight(outward, worldUp()) + kStyles[kStyle].key * (0.5 * wrapped(dot(outward, kKey)));
  vec3 rim = kStyles[kStyle].rim * (0.8 * graze * graze);
  pixel = vec4(filmic((colour.rgb * light + gloss + rim) * kStyles[kStyle].exposure) * alpha, alpha);
}
