// Mirrors tests/reference/detail.cpp.
#ifndef VASA_DETAIL
#define VASA_DETAIL
#include "lib/section.glsl"
#include "shared/detail.h"

struct SweepExtent {
  bool inView;
  float radiusPixels, bendPixels;
};

float heightOver(vec4 plane, vec4 ball) {
  precise float height = plane.x * ball.x + plane.y * ball.y + plane.z * ball.z + plane.w;
  return height;
}

float turnOf(Bezier z) {
  precise vec3 a = z.b1.xyz - z.b0.xyz, c = z.b3.xyz - z.b2.xyz;
  precise float size2 = dotOf(a, a) * dotOf(c, c);
  if (size2 <= kTiny2 * kTiny2) return 0.0;
  precise float turn = 2.0 - 2.0 * (dotOf(a, c) / sqrt(size2));
  return max(turn, 0.0);
}

float secondDifference(vec4 a, vec4 b, vec4 c) {
  precise vec4 d = a - 2.0 * b + c;
  precise float size = sqrt(dotOf(d.xyz, d.xyz)) + abs(d.w);
  return size;
}

SweepExtent sweepExtent(vec4 d0, vec4 d1, vec4 d2, vec4 d3, Bezier bezier, DetailView view) {
  for (uint i = 0; i < 5; ++i) {
    vec4 plane = view.planes[i];
    if (heightOver(plane, d0) < -d0.w && heightOver(plane, d1) < -d1.w && heightOver(plane, d2) < -d2.w &&
        heightOver(plane, d3) < -d3.w)
      return SweepExtent(false, 0, 0);
  }
  precise vec4 depths = vec4(heightOver(view.depth, d0) - view.reach * d0.w, heightOver(view.depth, d1) - view.reach * d1.w,
                             heightOver(view.depth, d2) - view.reach * d2.w, heightOver(view.depth, d3) - view.reach * d3.w);
  float depth = min(min(depths.x, depths.y), min(depths.z, depths.w));
  float radius = max(max(d0.w, d1.w), max(d2.w, max(d3.w, 0.0)));
  precise float scale = view.focal / max(depth, view.nearest);
  precise float radiusPixels = radius * scale;
  float bulge = max(secondDifference(bezier.b0, bezier.b1, bezier.b2), secondDifference(bezier.b1, bezier.b2, bezier.b3));
  precise float bendPixels = (0.75 * bulge + 0.125 * (radius * turnOf(bezier))) * scale;
  return SweepExtent(true, radiusPixels, bendPixels);
}

uint alongFor(float bendPixels, float tolerance) {
  precise float share = kAlongShare * tolerance;
  uint n = 1;
  while (n < kMaxAlong && bendPixels > float(n * n) * share) ++n;
  return n;
}

#endif
