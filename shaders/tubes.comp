#version 460
// A thread a sweep, a workgroup a group: vertices ring by ring, and the triangles between two rings that may be seen.
// What a thread writes has its place by the threads before it in the group, so nothing depends on their timing.
// CPU references: engine/surface/tessellate.h, engine/surface/visible.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/ring.glsl"
#include "lib/visible.glsl"

const uint kGroupThreads = kGroupSweeps;
#include "lib/group_sum.glsl"

layout(local_size_x = kGroupSweeps) in;
layout(push_constant, scalar) uniform Push { TubesPush push; };

struct Item {
  uint sweep, along, around, rings, before;  // before: rings of a first cap
  uint blocks;                               // of vertices
  uint vertex;                               // its first one
};

vec2 places[2 * kMaxAround];  // of this ring's vertices and the last one's, on the picture [samples]
vec2 polars[kCapRings + 1];
uint masks[kMaxStrips];       // bit 2k + i: triangle i of the quad behind direction k

Item itemOf(uint local) {
  uint item = gl_WorkGroupID.x * kGroupSweeps + local;
  Item it = Item(push.firstSweep + item, 0, 0, 0, 0, 0, 0);
  if (item >= push.sweepCount) return it;
  it.along = push.along.value[it.sweep];
  if (it.along == 0) return it;
  uint caps = push.sweeps.sweep[it.sweep].caps;
  it.around = push.around.value[push.sweeps.sweep[it.sweep].vessel];
  it.before = kCapRings * (caps & 1u);
  it.rings = it.before + it.along + 1 + kCapRings * (caps >> 1);
  it.blocks = (it.rings * it.around + kBlockVertices - 1) >> kBlockShift;
  return it;
}

void writeColours(Item it) {
  if (it.blocks == 0) return;
  uint colour = push.colours.value[it.sweep], first = it.vertex >> kBlockShift;
  for (uint k = 0; k < it.blocks; ++k) push.blockColours.value[first + k] = colour;
}

vec2 placeOf(vec3 position, mat4 viewProjection, vec2 samples) {
  vec4 clip = viewProjection * vec4(position, 1);
  if (clip.z > clip.w || clip.w <= 0) return vec2(kBehind);
  return (clip.xy / clip.w + 1.0) * (0.5 * samples) - 0.5;
}

void writeRing(Item it, uint ring, SweepCurve curve, vec2 step, mat4 viewProjection, vec2 samples) {
  uint inner = clamp(ring, it.before, it.before + it.along) - it.before;
  uint polarIndex = ring < it.before ? it.before - ring : ring - it.before - inner;
  Section section = ringSection(curve, inner, it.along);
  vec2 polar = polars[polarIndex];
  float outward = ring < it.before ? -1.0 : 1.0;
  uint target = it.vertex + ring * it.around, row = (ring & 1u) * kMaxAround;
  // Turned step by step as ringDirections() does, since a load costs a CPU device more than a rotation.
  vec2 direction = vec2(1, 0);
  for (uint k = 0; k < it.around; ++k) {
    SurfacePoint point = capPoint(section, direction, polar, outward);
    push.vertices.vertex[target + k] = packVertex(point);
    places[row + k] = placeOf(point.position, viewProjection, samples);
    precise vec2 next = vec2(direction.x * step.x - direction.y * step.y, direction.x * step.y + direction.y * step.x);
    direction = next;
  }
}

// Of the strip between the last ring and this one.
uint maskOf(uint ring, uint around, vec2 samples, float snap) {
  if (push.keepAll != 0) return 0xffffffffu >> (32 - 2 * around);
  uint near = (ring & 1u) * kMaxAround, far = kMaxAround - near, mask = 0;
  vec2 a = places[far], d = places[near];
  for (uint k = 0; k < around; ++k) {
    uint next = k + 1 == around ? 0 : k + 1;
    vec2 b = places[far + next], c = places[near + next];
    mask |= seenOfQuad(a, b, c, d, samples, snap) << (2 * k);
    a = b;
    d = c;
  }
  return mask;
}

uint writeStrip(uint mask, uint vertex, uint around, uint target) {
  for (; mask != 0; mask &= mask - 1) {
    uint bit = uint(findLSB(mask)), k = bit >> 1, next = k + 1 == around ? 0 : k + 1;
    uint a = vertex + k, c = vertex + around + next;
    push.indices.value[target++] = a;
    push.indices.value[target++] = (bit & 1u) == 0 ? vertex + next : c;
    push.indices.value[target++] = (bit & 1u) == 0 ? c : a + around;
  }
  return target;
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, triangles = 0;
  Item it = itemOf(local);
  it.vertex = group * push.verticesPerGroup + (sumBefore(local, it.blocks) << kBlockShift);
  writeColours(it);
  if (it.rings != 0) {
    SweepCurve curve = sweepCurve(push.points, push.knots, push.tables, push.sweeps.sweep[it.sweep]);
    mat4 viewProjection = push.view.view.viewProjection;
    vec2 samples = vec2(push.view.view.columns, push.view.view.rows);
    float snap = push.view.view.snap;
    for (uint i = 0; i <= kCapRings; ++i) polars[i] = i == 0 ? vec2(1, 0) : push.tables.tables.polar[i];
    vec2 step = push.tables.tables.step[it.around];
    for (uint ring = 0; ring < it.rings; ++ring) {
      writeRing(it, ring, curve, step, viewProjection, samples);
      if (ring == 0) continue;
      masks[ring - 1] = maskOf(ring, it.around, samples, snap);
      triangles += uint(bitCount(masks[ring - 1]));
    }
  }
  uint target = group * push.indicesPerGroup + 3 * sumBefore(local, triangles);
  for (uint ring = 1; ring < it.rings; ++ring)
    target = writeStrip(masks[ring - 1], it.vertex + (ring - 1) * it.around, it.around, target);
  if (local == kGroupSweeps - 1)
    push.draws.draw[group] = DrawCommand(target - group * push.indicesPerGroup, 1, group * push.indicesPerGroup, 0, 0);
}
