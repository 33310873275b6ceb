#version 460
// Never run: stands for a read by address before the validation layer (engine/gpu/address_shadow.h).
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) readonly buffer Touched { uint value; };

void main() {
  if (value == 1) barrier();  // an optimiser must not find the read useless
}
