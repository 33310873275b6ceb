#version 460
// A thread a seam of a patch. CPU reference: engine/surface/patch.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/ring.glsl"
#include "lib/fork.glsl"
#include "shared/patch.h"

layout(local_size_x = 64) in;
layout(push_constant, std430) uniform Push { PatchesPush push; };

vec3 centreOf(uint seam) {
  ForkRing ring = push.seams.seam[seam].ring;
  return pointAt(spanAt(push.points, push.tables, ring.point, ring.spanClass), ring.t).xyz;
}

// How a direction moves with the ring, at its own size.
struct Turn {
  vec3 across, beside, third;              // the patch's frame at rest
  vec3 posedAcross, posedBeside, posedThird;
  vec3 swing;                              // from its outward direction to the ring's, by the frame's turn alone
  float cosine, share;
};

Turn turnOf(PatchSeam seam, vec3 outward) {
  vec3 a = centreOf(seam.firstSeam), b = centreOf(seam.firstSeam + 1), c = centreOf(seam.firstSeam + 2);
  Turn turn;
  turn.across = seam.across;
  turn.beside = seam.beside;
  turn.third = crossOf(seam.across, seam.beside);
  precise vec3 along = b - a, side = c - a;
  turn.posedAcross = unitOr(along, seam.across);
  precise vec3 level = side - dotOf(side, turn.posedAcross) * turn.posedAcross;
  turn.posedBeside = unitOr(level, anyPerpendicular(turn.posedAcross));
  turn.posedThird = crossOf(turn.posedAcross, turn.posedBeside);
  precise vec3 framed = dotOf(seam.outward, turn.across) * turn.posedAcross +
                        dotOf(seam.outward, turn.beside) * turn.posedBeside +
                        dotOf(seam.outward, turn.third) * turn.posedThird;
  turn.swing = crossOf(framed, outward);
  turn.cosine = dotOf(framed, outward);
  precise float share = 1.0 / max(1.0 + turn.cosine, 1e-3);
  turn.share = share;
  return turn;
}

vec3 turnedBy(Turn turn, vec3 d) {
  precise vec3 f = dotOf(d, turn.across) * turn.posedAcross + dotOf(d, turn.beside) * turn.posedBeside +
                   dotOf(d, turn.third) * turn.posedThird;
  precise vec3 swung = turn.cosine * f + crossOf(turn.swing, f) + (turn.share * dotOf(turn.swing, f)) * turn.swing;
  return swung;
}

vec3 scaled(PatchSeam seam, float scale, vec3 d) {
  precise vec3 s = scale * d + ((1.0 - scale) * dotOf(seam.outward, d)) * seam.outward;
  return s;
}

void writeRow(uint row, vec4 values) {
  push.joints.row[row] = wordsOf(floatBitsToUint(values));
}

void writeJoint(uint i, PatchSeam seam, Section section, Turn turn) {
  precise float scale = section.radius / seam.radius;
  vec3 x = turnedBy(turn, scaled(seam, scale, vec3(1, 0, 0)));
  vec3 y = turnedBy(turn, scaled(seam, scale, vec3(0, 1, 0)));
  vec3 z = turnedBy(turn, scaled(seam, scale, vec3(0, 0, 1)));
  precise vec3 moved = section.centre - (seam.centre.x * x + seam.centre.y * y + seam.centre.z * z);
  writeRow(3 * i, vec4(x.x, y.x, z.x, moved.x));
  writeRow(3 * i + 1, vec4(x.y, y.y, z.y, moved.y));
  writeRow(3 * i + 2, vec4(x.z, y.z, z.z, moved.z));
}

uint corner = 0;
void addTriangle(uvec3 t) {
  writeTriangle(push.indices, corner, t);
  corner += 3;
}

// How many of the ring's edges lie beside the loop before its vertex k.
uint edgesBefore(PatchSeam seam, uint k, uint around) {
  if (k == seam.loopCount) return around;
  precise float place = push.shares.share[seam.loop + k] * float(around) + 0.5;
  return min(uint(place), around);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  PatchSeam seam = push.seams.seam[i];
  Ring ring = ringOf(push.points, push.knots, push.tables, seam.ring);
  precise vec3 outward = ring.turn * ring.section.tangent;
  Turn turn = turnOf(seam, outward);
  writeJoint(i, seam, ring.section, turn);

  uint around = push.around.value[seam.vessel];
  setDirections(0, stepAt(push.tables, around), around);
  for (uint k = 0; k < around; ++k)
    push.vertices.vertex[seam.vertex + k] = packVertex(surfacePoint(ring.section, directionAt(0, k)));
  uint first = seamAt(0, ring, turnedBy(turn, seam.start), around);
  bool backwards = ring.turn < 0;
  corner = seam.index;
  uint before = 0;
  for (uint k = 0; k < seam.loopCount; ++k) {
    uint loop = seam.loop + k, next = seam.loop + (k + 1) % seam.loopCount, after = edgesBefore(seam, k + 1, around);
    uint at = seam.vertex + (backwards ? first + around - before % around : first + before) % around;
    for (; before < after; ++before) {
      uint following = before + 1;
      uint to = seam.vertex + (backwards ? first + around - following % around : first + following) % around;
      addTriangle(uvec3(loop, to, at));
      at = to;
    }
    addTriangle(uvec3(loop, next, at));
  }
  for (uint rest = around; rest < kMaxAround; ++rest) addTriangle(uvec3(seam.vertex));  // no area
}
