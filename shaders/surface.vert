#version 460
// Tubes, caps and meshes: 16-byte vertices, one colour an item.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/octahedral.glsl"
#include "shared/draw.h"

layout(push_constant, scalar) uniform Push { DrawPush push; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 foldedNormal;
layout(location = 0) out vec3 normal;  // in the camera's axes
layout(location = 1) flat out vec3 colour;
invariant gl_Position;

vec3 linearOf(vec3 srgb) { return srgb * (srgb * (srgb * 0.305306011 + 0.682171111) + 0.012522878); }

void main() {
  uint item = push.colours.colour[push.firstItem + (uint(gl_VertexIndex) >> push.itemShift)];
  bool hidden = (push.hiddenKinds >> (item >> 24) & 1u) != 0u;
  gl_Position = hidden ? vec4(2, 2, 2, 1) : push.viewProjection * vec4(position, 1);  // outside the picture
  vec3 world = unpackOctahedral(foldedNormal);
  normal = vec3(dot(world, push.right), dot(world, push.up), dot(world, cross(push.right, push.up)));
  colour = linearOf(unpackUnorm4x8(item).rgb);
}
