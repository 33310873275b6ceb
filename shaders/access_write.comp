#version 460
// Never run: stands for a write by address before the validation layer (engine/gpu/address_shadow.h).
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer Touched { uint value; };

void main() { value = 0; }
