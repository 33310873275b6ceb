#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(push_constant, scalar) uniform Push {
  uvec2 corners;
  vec4 colour;
} push;
layout(location = 0) out vec4 colour;

void main() {
  colour = push.colour;
}
