// Mirrors ringSection of engine/surface/tessellate.cpp.
#ifndef VASA_RING
#define VASA_RING
#include "lib/octahedral.glsl"
#include "lib/section.glsl"
#include "shared/tubes.h"

// What all rings of a sweep share. The last ring is the first one of the span behind it, bit for bit.
struct SweepCurve {
  Bezier own, next;
  vec4 knots[4];  // at t = 0 and 1 of this span, then of the span behind it
  vec3 chord, nextChord;  // the vessel's where the span has none of its own
  float from, to;         // what of the span is drawn
  bool hasNext;
};

vec3 vesselChord(Points points, SweepRecord record, Bezier bezier) {
  vec3 ownChord = bezier.b3.xyz - bezier.b0.xyz;
  if (dotOf(ownChord, ownChord) > kTiny2) return vec3(0);  // the vessel's chord is never asked for
  return vec4Of(points.point[record.lastPoint]).xyz - vec4Of(points.point[record.firstPoint]).xyz;
}

SweepCurve sweepCurve(Points points, Knots knots, Tables tables, SweepRecord record) {
  SweepCurve curve;
  vec4 d1 = vec4Of(points.point[record.point + 1]), d2 = vec4Of(points.point[record.point + 2]);
  vec4 d3 = vec4Of(points.point[record.point + 3]);
  curve.own = bezierOf(tables.tables.spanClass[record.spanClass], vec4Of(points.point[record.point]), d1, d2, d3);
  curve.chord = vesselChord(points, record, curve.own);
  vec4 end = vec4Of(knots.knot[record.knot + 1]);
  curve.knots[0] = vec4Of(knots.knot[record.knot]);
  curve.knots[1] = curve.knots[2] = curve.knots[3] = end;
  curve.next = curve.own;
  curve.nextChord = curve.chord;
  curve.from = record.from;
  curve.to = record.to;
  curve.hasNext = record.nextClass != kNoSpan && record.to == 1;
  if (curve.hasNext) {
    curve.next = bezierOf(tables.tables.spanClass[record.nextClass], d1, d2, d3, vec4Of(points.point[record.point + 4]));
    curve.nextChord = vesselChord(points, record, curve.next);
    curve.knots[3] = vec4Of(knots.knot[record.knot + 2]);
  }
  return curve;
}

Section ringSection(SweepCurve curve, uint ring, uint along) {
  precise float t = ring == along ? curve.to : curve.from + (curve.to - curve.from) * (float(ring) / float(along));
  if (ring == along && curve.hasNext) return sectionAt(curve.next, curve.nextChord, curve.knots[2], curve.knots[3], 0);
  return sectionAt(curve.own, curve.chord, curve.knots[0], curve.knots[1], t);
}

// A TubeVertex in as few words as can be: storing them is most of what tessellation costs a CPU device.
u64vec2 packVertex(SurfacePoint point) {
  uvec3 place = floatBitsToUint(point.position);
  return u64vec2(pack64(place.xy), pack64(uvec2(place.z, packOctahedral(point.normal))));
}

#endif
