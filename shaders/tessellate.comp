#version 460
// A thread writes one ring of one sweep's template. CPU reference: engine/surface/tessellate.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/ring.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { TessellatePush push; };

void main() {
  uint rings = push.along + 1, item = gl_GlobalInvocationID.x / rings;
  if (item >= push.count) return;
  Section section = ringSection(push, push.first + item, gl_GlobalInvocationID.x % rings);
  uint target = gl_GlobalInvocationID.x * push.around;
  for (uint k = 0; k < push.around; ++k)
    push.vertices.vertex[target + k] = packVertex(surfacePoint(section, push.tables.direction[k]));
}
