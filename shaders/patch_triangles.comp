#version 460
// A workgroup a run of triangles of patches and their strips: those that may be seen, in their order, and an indirect draw.
// CPU reference: tests/reference/visible.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/picture_place.glsl"
#include "lib/records.glsl"
#include "lib/words.glsl"
#include "shared/patch.h"

const uint kGroupThreads = kPatchThreads;
#include "lib/group_sum.glsl"

layout(local_size_x = kPatchThreads) in;
layout(push_constant, std430) uniform Push { PatchTrianglesPush push; };

vec2 placeAt(uint vertex) { return placeOf(placeIn(push.vertices.vertex[vertex])); }

uvec3 triangleAt(uint triangle) {
  uint first = 3 * triangle;
  return uvec3(push.all.value[first], push.all.value[first + 1], push.all.value[first + 2]);
}

bool isSeen(uvec3 t) {
  if (push.keepAll != 0) return true;
  if (t.x == t.y) return false;  // a strip's room that is not used
  vec2 c = placeAt(t.z);
  return (seenOfQuad(placeAt(t.x), placeAt(t.y), c, c, gridOf(view)) & 1u) != 0u;
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x;
  uint first = (group * kPatchThreads + local) * kThreadTriangles, seen = 0;
  view = viewAt(push.view);
  for (uint k = 0; k < kThreadTriangles && first + k < push.count; ++k)
    if (isSeen(triangleAt(first + k))) seen |= 1u << k;
  uint count = uint(bitCount(seen)), before = sumBefore(local, count);
  uint start = 3 * kPatchThreads * kThreadTriangles * group, target = start + 3 * before;
  for (uint k = 0; k < kThreadTriangles; ++k) {
    if ((seen >> k & 1u) == 0u) continue;
    writeTriangle(push.indices, target, triangleAt(first + k));
    target += 3;
  }
  if (local == kPatchThreads - 1) push.draws.draw[group] = DrawCommand(3 * (before + count), 1, start, 0, 0);
}
