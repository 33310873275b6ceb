#version 460
// Never run: stands for a read by address before the validation layer (engine/gpu/address_shadow.h).
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) volatile readonly buffer Touched { uint value; };

void main() { uint seen = value; }
