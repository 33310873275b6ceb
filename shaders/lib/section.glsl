// Mirrors engine/surface/section.cpp and what it uses of engine/curve: the same operations in the same order,
// kept from being fused or reordered, so that both round alike.
#ifndef VASA_SECTION
#define VASA_SECTION
#include "lib/words.glsl"

const float kTiny2 = 1e-20;     // squared lengths below this carry no direction
const float kFoldGuard = 0.1;   // least 1 - r κ·d

struct Bezier { vec4 b0, b1, b2, b3; };

struct Section {
  vec3 centre;
  float radius;
  vec3 u, v, tangent;
  float slope;      // dr/ds
  vec3 curvature;
};

struct SurfacePoint { vec3 position, normal; };

float dotOf(vec3 a, vec3 b) {
  precise vec3 product = a * b;
  precise float sum = product.x + product.y + product.z;
  return sum;
}

vec3 crossOf(vec3 a, vec3 b) {
  precise vec3 c = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
  return c;
}

vec3 unitOf(vec3 a) {
  precise vec3 unit = a / sqrt(dotOf(a, a));
  return unit;
}

vec3 anyPerpendicular(vec3 n) {
  float side = (floatBitsToUint(n.z) >> 31) != 0u ? -1.0 : 1.0;
  precise float a = -1.0 / (side + n.z);
  precise vec3 p = vec3(1.0 + side * n.x * n.x * a, side * n.x * n.y * a, -side * n.x);
  return p;
}

// The matrix' other elements are 0 whatever the knots.
Bezier bezierOf(mat4 m, vec4 d0, vec4 d1, vec4 d2, vec4 d3) {
  precise Bezier z;
  z.b0 = m[0][0] * d0 + m[1][0] * d1 + m[2][0] * d2;
  z.b1 = m[1][1] * d1 + m[2][1] * d2;
  z.b2 = m[1][2] * d1 + m[2][2] * d2;
  z.b3 = m[1][3] * d1 + m[2][3] * d2 + m[3][3] * d3;
  return z;
}

vec4 pointAt(Bezier z, float t) {
  precise float s = 1 - t;
  precise vec4 w = vec4(s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t);
  precise vec4 p = w.x * z.b0 + w.y * z.b1 + w.z * z.b2 + w.w * z.b3;
  return p;
}

vec4 derivativeAt(Bezier z, float t) {
  precise float s = 1 - t;
  precise vec4 p = 3.0 * (s * s * (z.b1 - z.b0) + 2 * s * t * (z.b2 - z.b1) + t * t * (z.b3 - z.b2));
  return p;
}

vec3 secondDerivativeAt(Bezier z, float t) {
  precise vec3 p = 6.0 * ((1 - t) * (z.b0.xyz - 2.0 * z.b1.xyz + z.b2.xyz) +
                          t * (z.b1.xyz - 2.0 * z.b2.xyz + z.b3.xyz));
  return p;
}

vec3 tangentOf(Bezier z, vec3 derivative, vec3 vesselChord) {
  vec3 chord = z.b3.xyz - z.b0.xyz;
  vec3 along = dotOf(derivative, derivative) > kTiny2 ? derivative : dotOf(chord, chord) > kTiny2 ? chord : vesselChord;
  return dotOf(along, along) > kTiny2 ? unitOf(along) : vec3(0, 0, 1);
}

// The first axis of the blend of two quaternions (x y z w), at right angles to the tangent.
vec3 blendedAxis(vec4 from, vec4 to, float t, vec3 tangent) {
  precise vec4 q = from * (1 - t) + to * t;
  precise vec4 square = q * q;
  precise float size = sqrt((square.w + square.x) + (square.y + square.z));
  if (size <= 0) {
    q = vec4(0, 0, 0, 1);
  } else {
    precise float scale = 1.0 / size;
    q = q * scale;
  }
  vec3 x = vec3(1, 0, 0);
  vec3 once = crossOf(q.xyz, x), twice = crossOf(q.xyz, once);
  precise vec3 rotated = x + ((once * q.w) + twice) * 2.0;
  precise vec3 u = rotated - dotOf(rotated, tangent) * tangent;
  float size2 = dotOf(u, u);
  if (size2 > 1e-12) {
    precise vec3 unit = u / sqrt(size2);
    return unit;
  }
  return anyPerpendicular(tangent);
}

Section sectionAt(Bezier z, vec3 vesselChord, vec4 from, vec4 to, float t) {
  vec4 point = pointAt(z, t), first = derivativeAt(z, t);
  vec3 acceleration = secondDerivativeAt(z, t);
  Section section;
  section.centre = point.xyz;
  section.radius = max(point.w, 0.0);
  section.tangent = tangentOf(z, first.xyz, vesselChord);
  section.u = blendedAxis(from, to, t, section.tangent);
  section.v = crossOf(section.tangent, section.u);
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

vec3 ringDirection(Section section, vec2 direction) {
  precise vec3 d = direction.x * section.u + direction.y * section.v;
  return d;
}

SurfacePoint surfacePoint(Section section, vec2 direction) {
  vec3 d = ringDirection(section, direction);
  precise float fold = max(1.0 - section.radius * dotOf(section.curvature, d), kFoldGuard);
  precise vec3 normal = d - (section.slope / fold) * section.tangent;
  precise vec3 position = section.centre + section.radius * d;
  return SurfacePoint(position, unitOf(normal));
}

// One of a cap's points, or with polar (1, 0) the tube's own.
SurfacePoint capPoint(Section section, vec2 direction, vec2 polar, float outward) {
  vec3 d = ringDirection(section, direction);
  precise float fold = max(1.0 - section.radius * dotOf(section.curvature, d), kFoldGuard);
  precise float along = polar.y == 0 ? -(section.slope / fold) : outward * polar.y;
  precise vec3 normal = polar.x * d + along * section.tangent;
  precise vec3 reach = polar.y == 0 ? d : normal;
  precise vec3 position = section.centre + section.radius * reach;
  return SurfacePoint(position, unitOf(normal));
}

#endif
