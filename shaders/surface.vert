#version 460
// Tubes, caps and meshes: 16-byte vertices, one colour an item.
#extension GL_GOOGLE_include_directive : require
#include "lib/octahedral.glsl"
#include "lib/view.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 foldedNormal;
layout(location = 0) out vec3 normal;  // in the camera's axes
layout(location = 1) flat out vec4 colour;  // linear, and opacity
layout(location = 2) flat out float layer;
invariant gl_Position;

vec3 linearOf(vec3 srgb) { return srgb * (srgb * (srgb * 0.305306011 + 0.682171111) + 0.012522878); }

void main() {
  uint item = push.colours.colour[uint(gl_VertexIndex) >> (push.shiftAndOpacities & 31u)], kind = item >> 24;
  bool hidden = (push.hiddenKinds >> kind & 1u) != 0u;
  gl_Position = hidden ? vec4(2, 2, 2, 1) : push.viewProjection * vec4(position, 1);  // outside the picture
  vec3 world = unpackOctahedral(foldedNormal);
  normal = world + 2 * cross(push.turn.xyz, cross(push.turn.xyz, world) + push.turn.w * world);
  uint slot = kind == 0u || kind >= kMeshKind ? 0u : kind <= 2u ? 1u : 2u;  // arteries and meshes, veins, others
  float opacity = kPartial == 0 ? 1.0 : unpackUnorm4x8(push.shiftAndOpacities >> 8)[slot];
  colour = vec4(linearOf(unpackUnorm4x8(item).rgb), opacity);
  layer = float(kind);
}
