// Mirrors engine/surface/visible.cpp: may a quad's triangles cover a sample of the picture with their fronts?
#ifndef VASA_VISIBLE
#define VASA_VISIBLE
#include "shared/tubes.h"

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Twice the areas of (p, p + edge, sample) for four samples: above 0 beyond the edge of a front, as y points down.
vec4 beyond(vec2 p, vec2 edge, vec2 first, vec2 span) {
  float at = cross2(edge, first - p), alongX = -edge.y * span.x, alongY = edge.x * span.y;
  return vec4(at, at + alongX, at + alongY, at + alongX + alongY);
}

bool covers(vec4 outside, float margin) {
  return min(min(outside.x, outside.y), min(outside.z, outside.w)) <= margin;
}

uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap) {
  vec2 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
  if (high.x >= 0.5 * kBehind) return 3;
  vec2 first = max(ceil(low - snap), 0.0), last = min(floor(high + snap), samples - 1.0), span = last - first;
  if (span.x < 0 || span.y < 0) return 0;
  vec2 size = high - low, ab = b - a, ac = c - a, ad = d - a;
  float margin = 4 * snap * (size.x + size.y + snap);
  bool abc = cross2(ab, ac) <= margin, acd = cross2(ac, ad) <= margin;
  if (span.x <= 1 && span.y <= 1) {  // small: each of its samples is looked at
    vec4 across = beyond(a, ac, first, span);
    abc = abc && covers(max(max(beyond(a, ab, first, span), beyond(b, c - b, first, span)), -across), margin);
    acd = acd && covers(max(max(beyond(c, d - c, first, span), beyond(d, -ad, first, span)), across), margin);
  }
  return (abc ? 1u : 0u) | (acd ? 2u : 0u);
}

#endif
