#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/opaque.glsl"

void main() { pixel = litPixel(); }
