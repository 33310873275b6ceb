#version 460
// A thread a sweep: is it in view, how many quads along does the picture ask for, and how large is its vessel on it.
// CPU reference: tests/reference/detail.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/detail.glsl"
#include "lib/records.glsl"

layout(local_size_x = 64) in;
layout(push_constant, std430) uniform Push { MeasurePush push; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  DetailView view = viewAt(push.view);
  SweepRecord record = sweepAt(push.sweeps, i);
  vec4 d0 = vec4Of(push.points.point[record.point]), d1 = vec4Of(push.points.point[record.point + 1]);
  vec4 d2 = vec4Of(push.points.point[record.point + 2]), d3 = vec4Of(push.points.point[record.point + 3]);
  Bezier bezier = Bezier(d0, d1, d2, d3);
  if (view.along == 0) bezier = bezierOf(spanClassAt(push.tables, record.spanClass), d0, d1, d2, d3);
  SweepExtent extent = sweepExtent(d0, d1, d2, d3, bezier, view);
  bool shown = extent.inView && (view.hiddenKinds >> (push.colours.value[i] >> 24) & 1u) == 0u;
  uint along = view.along != 0 ? view.along : alongFor(extent.bendPixels, view.tolerance);
  push.along.value[i] = shown ? along : 0;
  // Bits of floats that are not negative are ordered as the floats are.
  if (view.around == 0 && extent.inView) atomicMax(push.sizes.size[record.vessel], floatBitsToUint(extent.radiusPixels));
}
