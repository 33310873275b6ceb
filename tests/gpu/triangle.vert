#version 460
#extension GL_EXT_buffer_reference : require

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Corners {
  vec3 positions[];
};
layout(push_constant, std430) uniform Push {
  Corners corners;
  vec4 colour;
} push;

void main() {
  gl_Position = vec4(push.corners.positions[gl_VertexIndex], 1.0);
}
