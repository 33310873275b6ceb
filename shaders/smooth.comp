#version 460
// A thread a pixel: the mean of occlusion over a tile of its neighbours on the same surface.
// CPU reference: engine/render/occlusion.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/occlusion.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { OcclusionPush push; };

void main() {
  uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (i >= push.width * push.height) return;
  float depth = push.depth.value[i], sum = 0, weights = 0;
  if (depth <= 0) {
    push.light.value[i] = 1;
    return;
  }
  ivec2 pixel = ivec2(i % push.width, i / push.width), last = ivec2(push.width, push.height) - 1;
  for (int y = -2; y < 2; ++y)
    for (int x = -2; x < 2; ++x) {
      ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), last);
      uint at = uint(other.y) * push.width + uint(other.x);
      float weight = max(1.0 - 100.0 * abs(push.depth.value[at] - depth) / depth, 0.0);
      sum += weight * push.raw.value[at];
      weights += weight;
    }
  push.light.value[i] = weights > 0 ? sum / weights : push.raw.value[i];
}
