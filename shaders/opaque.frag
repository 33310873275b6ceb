#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#include "shared/draw.h"

layout(push_constant, std430) uniform Push { DrawPush push; };
#include "lib/opaque.glsl"

void main() { pixel = litPixel(); }
