// Mirrors ringSection of engine/surface/tessellate.cpp.
#ifndef VASA_RING
#define VASA_RING
#include "lib/octahedral.glsl"
#include "lib/section.glsl"
#include "shared/tessellate.h"

Section ringSection(TessellatePush push, uint sweep, uint ring) {
  SweepRecord record = push.sweeps.sweep[sweep];
  precise float t = float(ring) / float(push.along);
  uint spanClass = record.spanClass, step = 0;
  if (ring == push.along && record.nextClass != kNoSpan) {  // the next span's first ring, bit for bit
    spanClass = record.nextClass;
    step = 1;
    t = 0;
  }
  uint point = record.point + step, knot = record.knot + step;
  Bezier bezier = bezierOf(push.tables.spanClass[spanClass], push.points.point[point], push.points.point[point + 1],
                           push.points.point[point + 2], push.points.point[point + 3]);
  vec3 chord = vec3(0), ownChord = bezier.b3.xyz - bezier.b0.xyz;
  if (dotOf(ownChord, ownChord) <= kTiny2)  // otherwise the vessel's chord is never asked for
    chord = push.points.point[record.lastPoint].xyz - push.points.point[record.firstPoint].xyz;
  return sectionAt(bezier, chord, push.knots.knot[knot], push.knots.knot[knot + 1], t);
}

TubeVertex packVertex(SurfacePoint point) {
  return TubeVertex(point.position.x, point.position.y, point.position.z, packOctahedral(point.normal));
}

#endif
