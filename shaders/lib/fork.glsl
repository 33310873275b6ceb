// Mirrors engine/surface/fork.cpp: the same operations in the same order.
#ifndef VASA_FORK
#define VASA_FORK
#include "lib/records.glsl"
#include "shared/fork.h"

const float kRound = 0.55;  // of a quarter circle's control polygon
const float kDense = 0.4;   // rows of the collar beside the hole, against even ones

struct Ring {
  Section section;
  vec4 derivative;
  float turn;
};

vec3 unitOr(vec3 a, vec3 otherwise) {
  float size2 = dotOf(a, a);
  precise vec3 unit = a / sqrt(size2);
  return size2 > kTiny2 ? unit : otherwise;
}

Ring ringOf(Points points, Knots knots, Tables tables, ForkRing ring) {
  Bezier z = spanAt(points, tables, ring.point, ring.spanClass);
  vec3 chord = chordOf(points, ring.firstPoint, ring.lastPoint);
  return Ring(sectionAt(z, chord, vec4Of(knots.knot[ring.knot]), vec4Of(knots.knot[ring.knot + 1]), ring.t), derivativeAt(z, ring.t),
              ring.turn);
}

vec4 innerPoint(Ring ring, float thirdScale) {
  precise vec4 moved = vec4(ring.section.centre, ring.section.radius) + thirdScale * ring.derivative;
  moved.w = clamp(moved.w, 0.5 * ring.section.radius, 2.0 * ring.section.radius);
  return moved;
}

struct Trunk {
  Bezier bezier;
  vec3 chord;
};

Section trunkAt(Trunk trunk, float s) {
  vec4 point = pointAt(trunk.bezier, s), first = derivativeAt(trunk.bezier, s);
  vec3 acceleration = secondDerivativeAt(trunk.bezier, s);
  Section section;
  section.centre = point.xyz;
  section.radius = max(point.w, 0.0);
  section.tangent = unitOr(first.xyz, unitOr(trunk.chord, vec3(0, 0, 1)));
  section.u = section.v = vec3(0);
  section.slope = 0;
  section.curvature = vec3(0);
  float speed2 = dotOf(first.xyz, first.xyz);
  if (speed2 > kTiny2) {
    precise float slope = first.w / sqrt(speed2);
    precise vec3 curvature = (acceleration - dotOf(acceleration, section.tangent) * section.tangent) / speed2;
    section.slope = slope;
    section.curvature = curvature;
  }
  return section;
}

vec3 carried(vec3 direction, vec3 from, vec3 fromTangent, vec3 to, vec3 toTangent) {
  precise vec3 u = direction, tangent = fromTangent;
  precise vec3 v1 = to - from;
  float c1 = dotOf(v1, v1);
  if (c1 > kTiny2) {
    precise float scale = 2.0 / c1;
    precise float along = scale * dotOf(v1, u), alongTangent = scale * dotOf(v1, tangent);
    u = u - along * v1;
    tangent = tangent - alongTangent * v1;
  }
  precise vec3 v2 = toTangent - tangent;
  float c2 = dotOf(v2, v2);
  if (c2 > 1e-12) {
    precise float along = (2.0 / c2) * dotOf(v2, u);
    u = u - along * v2;
  }
  u = u - dotOf(u, toTangent) * toTangent;
  return unitOr(u, anyPerpendicular(toTangent));
}

// The direction to a point, at right angles to the section's tangent.
vec3 levelled(Section section, vec3 point) {
  precise vec3 away = point - section.centre;
  precise vec3 level = away - dotOf(away, section.tangent) * section.tangent;
  return unitOr(level, section.u);
}

Section framed(Section section, vec3 u) {
  section.u = u;
  section.v = crossOf(section.tangent, u);
  return section;
}

// The trunk's section at s, its frame carried from the middle.
Section wallAt(Trunk trunk, Section middle, float s) {
  Section section = trunkAt(trunk, s);
  return framed(section, carried(middle.u, middle.centre, middle.tangent, section.centre, section.tangent));
}

vec2 turned(vec2 a, vec2 b) {
  precise vec2 c = vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
  return c;
}

// Direction k of m, as ringDirections() finds it, of each ring: the trunk's two ends, then branches.
Word directions[(2 + kMostBranches) * kMaxAround];

vec2 directionAt(uint part, uint k) { return vec2Of(directions[part * kMaxAround + k]); }

void setDirections(uint part, vec2 step, uint around) {
  precise vec2 direction = vec2(1, 0);
  for (uint k = 0; k < around; ++k) {
    directions[part * kMaxAround + k] = wordOf(direction);
    direction = turned(direction, step);
  }
}

// The one of the directions nearest to another.
uint nearestOf(uint part, vec2 wanted, uint around) {
  uint first = 0;
  float best = -3e38;
  for (uint k = 0; k < around; ++k) {
    vec2 direction = directionAt(part, k);
    precise float along = wanted.x * direction.x + wanted.y * direction.y;
    if (along > best) {
      best = along;
      first = k;
    }
  }
  return first;
}

// First vertex of the ring for a row that begins in this direction.
uint seamAt(uint part, Ring ring, vec3 wanted, uint around) {
  return nearestOf(part, vec2(dotOf(wanted, ring.section.u), dotOf(wanted, ring.section.v)), around);
}

vec2 seamDirection(uint part, float turn, uint first, uint k, uint around) {
  uint at = turn < 0 ? first + around - k : first + k;  // below 2 around; a CPU device divides whole numbers lane by lane
  return directionAt(part, at < around ? at : at - around);
}

float collarParameter(uint row) {
  precise float share = float(row) / float(kCollarRows);
  precise float t = share * (kDense + (1.0 - kDense) * share);
  return t;
}

// Where the hole's middle lies, in the trunk's frame: as wanted, or the nearest direction that keeps it in its window.
vec2 holeDirection(ForkBranch branch, vec2 wanted, vec2 windowMiddle, vec2 windowHalf) {
  vec2 off = turned(wanted, vec2(windowMiddle.x, -windowMiddle.y));
  vec2 room = turned(windowHalf, vec2(branch.holdCos, -branch.holdSin));
  if (room.y <= 0) return windowMiddle;
  if (off.x >= room.x) return wanted;
  return turned(windowMiddle, vec2(room.x, off.y < 0 ? -room.y : room.y));
}

struct CollarCurve {
  vec3 h, h1, p1, p;
  vec3 aroundH, aroundP;
};

SurfacePoint collarAt(CollarCurve c, float t) {
  precise float s = 1 - t;
  precise vec3 position = (s * s * s) * c.h + (3 * s * s * t) * c.h1 + (3 * s * t * t) * c.p1 + (t * t * t) * c.p;
  precise vec3 along = (s * s) * (c.h1 - c.h) + (2 * s * t) * (c.p1 - c.h1) + (t * t) * (c.p - c.p1);
  precise vec3 around = s * c.aroundH + t * c.aroundP;
  return SurfacePoint(position, unitOr(crossOf(around, along), vec3(0, 0, 1)));
}

#endif
