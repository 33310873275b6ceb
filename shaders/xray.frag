#version 460
// Light that gathers along the line of sight, most where a surface turns away; added up, so the order of surfaces does
// not matter.
#extension GL_GOOGLE_include_directive : require
#include "lib/view.glsl"

layout(location = 0) in vec3 normal;
layout(location = 1) flat in vec4 colour;
layout(location = 0) out vec4 pixel;  // premultiplied

void main() {
  if (cutOff(gl_FragCoord)) discard;
  vec3 eye = eyeAt(gl_FragCoord.xy);
  float away = 1 - abs(dot(normalize(normal), eye));
  float gathered = push.opacity * colour.a * (0.12 + 0.88 * away * away);
  pixel = vec4(colour.rgb * gathered, gathered);
}
