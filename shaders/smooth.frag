#version 460
// The mean of occlusion over a tile of a pixel's neighbours on the same surface. CPU reference: tests/reference/occlusion.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/occlusion.h"

layout(push_constant, std430) uniform Push { OcclusionPush push; };
layout(set = 0, binding = 0) uniform texture2D depths;  // of the picture, 0: background
layout(set = 0, binding = 1) uniform texture2D raw;     // what occlusion.frag found
layout(location = 0) out float light;

void main() {
  const int reach = int(kOcclusionTile) / 2;
  ivec2 here = ivec2(gl_FragCoord.xy), last = ivec2(push.width, push.height) - 1;
  float depth = texelFetch(depths, here, 0).x, sum = 0, weights = 0;
  for (int y = -reach; y < reach; ++y)
    for (int x = -reach; x < reach; ++x) {
      ivec2 other = clamp(here + ivec2(x, y), ivec2(0), last);
      float weight = max(1.0 - 100.0 * abs(texelFetch(depths, other, 0).x - depth) / depth, 0.0);
      sum += weight * texelFetch(raw, other, 0).x;
      weights += weight;
    }
  light = sum / weights;  // its own weight is 1
}
