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
  // Turned step by step as ringDirections() does, since a load costs a CPU device more than a rotation.
  vec2 step = push.tables.direction[1], direction = vec2(1, 0);
  for (uint k = 0; k < push.around; ++k) {
    push.vertices.vertex[target + k] = packVertex(surfacePoint(section, direction));
    precise vec2 next = vec2(direction.x * step.x - direction.y * step.y, direction.x * step.y + direction.y * step.x);
    direction = next;
  }
}
