#version 460
// A thread writes the template of one end's cap. CPU reference: engine/surface/tessellate.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/ring.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { TessellatePush push; };

void main() {
  uint item = gl_GlobalInvocationID.x;
  if (item >= push.count) return;
  uint cap = push.caps.cap[push.first + item];
  bool last = (cap & 1u) != 0u;
  float outward = last ? 1.0 : -1.0;
  Section section = ringSection(push, cap >> 1, last ? push.along : 0u);
  uint target = item * (kCapRings * push.around + 1u);
  for (uint j = 0; j < kCapRings; ++j)
    for (uint k = 0; k < push.around; ++k) {
      uint direction = last ? k : (push.around - k) % push.around;
      push.vertices.vertex[target++] =
          packVertex(capPoint(section, push.tables.direction[direction], push.tables.polar[j], outward));
    }
  push.vertices.vertex[target] =
      packVertex(capPoint(section, push.tables.direction[0], push.tables.polar[kCapRings], outward));
}
