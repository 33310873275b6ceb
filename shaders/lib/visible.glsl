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

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, vec2 samples, float snap) {
  vec2 low = min(min(a, b), c), high = max(max(a, b), c);
  vec2 first = max(ceil(low - snap), 0.0), last = min(floor(high + snap), samples - 1.0), span = last - first;
  vec2 size = high - low, ab = b - a, ac = c - a;
  float margin = 4 * snap * (size.x + size.y + snap);
  bool seen = span.x >= 0 && span.y >= 0 && cross2(ab, ac) <= margin;
  bool small = span.x <= 1 && span.y <= 1;  // each of its samples is looked at
  vec4 outside = max(max(beyond(a, ab, first, span), beyond(b, c - b, first, span)), beyond(c, -ac, first, span));
  return high.x >= 0.5 * kBehind || (seen && (!small || covers(outside, margin)));
}

uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap) {
  return (seenOfTriangle(a, b, c, samples, snap) ? 1u : 0u) | (seenOfTriangle(a, c, d, samples, snap) ? 2u : 0u);
}

#endif
