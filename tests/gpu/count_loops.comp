#version 460
#extension GL_EXT_buffer_reference : require

// How many of `wanted` iterations a loop really makes.
layout(local_size_x = 1) in;

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Count {
  uint value;
};
layout(push_constant, std430) uniform Push {
  Count counted;
  uint wanted;
} push;

void main() {
  uint made = 0;
  uint state = 1;
  // The generator keeps the compiler from knowing the sum.
  for (uint i = 0; i < push.wanted; ++i) {
    state = state * 1664525u + 1013904223u;
    made += state == 0 ? 1 : 1 + (state & 0u);
  }
  push.counted.value = made;
}
