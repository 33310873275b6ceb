#version 460
#extension GL_EXT_buffer_reference : require

// values[i] = factor * values[i], for i < count; kOverrun more are written when a test plants that fault.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const float kFactor = 2.0;
layout(constant_id = 2) const uint kOverrun = 0;

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Floats {
  float values[];
};
layout(push_constant, std430) uniform Push {
  Floats floats;
  uint count;
} push;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= push.count + kOverrun) return;
  push.floats.values[i] *= kFactor;
}
