#version 460
#extension GL_EXT_buffer_reference : require

layout(push_constant, std430) uniform Push {
  uvec2 corners;
  vec4 colour;
} push;
layout(location = 0) out vec4 colour;

void main() {
  colour = push.colour;
}
