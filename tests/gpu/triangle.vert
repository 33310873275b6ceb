#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners {
  vec3 positions[];
};
layout(push_constant, scalar) uniform Push {
  Corners corners;
  vec4 colour;
} push;

void main() {
  gl_Position = vec4(push.corners.positions[gl_VertexIndex], 1.0);
}
