// Mirrors ringSection of engine/surface/tessellate.cpp.
#ifndef VASA_RING
#define VASA_RING
#include "lib/octahedral.glsl"
#include "lib/records.glsl"

// What all rings of a sweep share. The last ring is the first one of the span behind it, bit for bit.
struct SweepCurve {
  Bezier own, next;
  vec4 knots[4];  // at t = 0 and 1 of this span, then of the span behind it
  vec3 chord;             // the vessel's, where a span has none of its own
  float from, to;         // what of the span is drawn
  bool hasNext;
};

bool hasChord(Bezier bezier) {
  vec3 chord = bezier.b3.xyz - bezier.b0.xyz;
  return dotOf(chord, chord) > kTiny2;
}

SweepCurve sweepCurve(Points points, Knots knots, Tables tables, SweepRecord record) {
  SweepCurve curve;
  vec4 d1 = vec4Of(points.point[record.point + 1]), d2 = vec4Of(points.point[record.point + 2]);
  vec4 d3 = vec4Of(points.point[record.point + 3]);
  curve.own = bezierOf(spanClassAt(tables, record.spanClass), vec4Of(points.point[record.point]), d1, d2, d3);
  vec4 end = vec4Of(knots.knot[record.knot + 1]);
  curve.knots[0] = vec4Of(knots.knot[record.knot]);
  curve.knots[1] = curve.knots[2] = curve.knots[3] = end;
  curve.next = curve.own;
  curve.from = record.from;
  curve.to = record.to;
  curve.hasNext = record.nextClass != kNoSpan && record.to == 1;
  if (curve.hasNext) {
    curve.next = bezierOf(spanClassAt(tables, record.nextClass), d1, d2, d3, vec4Of(points.point[record.point + 4]));
    curve.knots[3] = vec4Of(knots.knot[record.knot + 2]);
  }
  curve.chord = vec3(0);
  if (!hasChord(curve.own) || !hasChord(curve.next))
    curve.chord = chordOf(points, record.firstPoint, record.lastPoint);
  return curve;
}

Section ringSection(SweepCurve curve, uint ring, uint along) {
  precise float t = ring == along ? curve.to : curve.from + (curve.to - curve.from) * (float(ring) / float(along));
  bool next = ring == along && curve.hasNext;  // chosen first: a CPU device evaluates both sides of a branch
  Bezier bezier = Bezier(next ? curve.next.b0 : curve.own.b0, next ? curve.next.b1 : curve.own.b1,
                         next ? curve.next.b2 : curve.own.b2, next ? curve.next.b3 : curve.own.b3);
  return sectionAt(bezier, curve.chord, next ? curve.knots[2] : curve.knots[0], next ? curve.knots[3] : curve.knots[1],
                   next ? 0.0 : t);
}

// A TubeVertex in as few words as can be: storing them is most of what tessellation costs a CPU device.
Word2 packVertex(SurfacePoint point) {
  return vertexWords(point.position, packOctahedral(point.normal));
}

#endif
