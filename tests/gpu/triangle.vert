#version 460
#extension GL_EXT_buffer_reference : require

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Corners {
  float coordinates[];
};
layout(push_constant, std430) uniform Push {
  Corners corners;
  vec4 colour;
} push;

void main() {
  const uint first = 3 * gl_VertexIndex;
  gl_Position = vec4(push.corners.coordinates[first], push.corners.coordinates[first + 1], push.corners.coordinates[first + 2], 1.0);
}
