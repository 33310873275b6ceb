// Mirrors the collars of engine/surface/fork.cpp: the same operations in the same order.
#ifndef VASA_FORK_COLLAR
#define VASA_FORK_COLLAR
#include "lib/fork_rows.glsl"

// `at`: the trunk's section at the hole's middle. @return the ring's first vertex
uint collar(uint part, ForkBranch record, Ring branch, uint start, uint around, vec2 towards, Section at, Trunk trunk,
            Section middle) {
  precise vec3 outward = branch.turn * branch.section.tangent;
  precise vec3 wanted = towards.x * at.u + towards.y * at.v, side = towards.x * at.v - towards.y * at.u;
  precise vec3 sum = wanted + outward;
  precise float fold = max(1.0 + dotOf(wanted, outward), 1e-3);
  precise vec3 across = side - (dotOf(side, sum) / fold) * sum;
  uint first = seamAt(part, branch, across, around);
  for (uint k = 0; k < around; ++k) {
    vec2 polar = directionAt(part, k);
    precise float x = record.holeAround * polar.x;
    precise float depth = sqrt(1.0 - x * x);
    // The corner's section, then the hole's.
    Section section;
    SurfacePoint hole, corner;
    float s;
    [[dont_unroll]] for (uint place = 0; place < 2; ++place) {
      precise float way = place == 1 ? record.holeAlong : record.cornerAlong * record.holeAlong;
      precise float aside = place == 1 ? x : record.cornerAround * x;
      precise float there = record.centre + way * polar.y, deep = sqrt(1.0 - aside * aside);
      section = wallAt(trunk, middle, there);
      s = there;
      SurfacePoint point = surfacePoint(section, turned(towards, vec2(deep, aside)));
      if (place == 1) hole = point;
      else corner = point;
    }
    precise vec3 chord = corner.position - hole.position;
    precise vec3 inwards = chord - dotOf(chord, hole.normal) * hole.normal;

    vec2 direction = seamDirection(part, branch.turn, first, k, around);
    SurfacePoint end = surfacePoint(branch.section, direction);
    vec3 d = ringDirection(branch.section, direction);
    precise float bend = max(1.0 - branch.section.radius * dotOf(branch.section.curvature, d), 0.1);
    precise vec3 along = bend * outward + (branch.turn * branch.section.slope) * d;
    vec3 ruling = unitOr(along, outward);
    precise vec3 reach = end.position - (hole.position + inwards);
    precise float rise = max(dotOf(reach, ruling), 0.35 * sqrt(dotOf(reach, reach)));
    precise vec3 h1 = hole.position + kRound * inwards, p1 = end.position - (kRound * rise) * ruling;
    precise float slide = -(record.holeAround * polar.y);
    precise vec2 slip = vec2(-(slide * x / depth), slide);
    vec2 sideways = turned(towards, slip);
    vec3 velocity = derivativeAt(trunk.bezier, s).xyz;
    precise vec3 aroundH = section.radius * (sideways.x * section.u + sideways.y * section.v) +
                           (record.holeAlong * polar.x) * velocity;
    precise vec3 aroundP = (branch.turn * branch.section.radius) *
                           (direction.x * branch.section.v - direction.y * branch.section.u);
    CollarCurve curve = CollarCurve(hole.position, h1, p1, end.position, aroundH, aroundP);
    [[dont_unroll]] for (uint row = 0; row <= kCollarRows; ++row) {
      SurfacePoint point = collarAt(curve, collarParameter(row));
      if (row == 0) point = hole;
      if (row == kCollarRows) point = end;
      put(start + row * around + k, point);
    }
  }
  return first;
}

#endif
