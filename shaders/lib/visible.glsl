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

// The same beyond the edge moved outwards as far as its ends may be.
vec4 wellBeyond(vec2 p, vec2 edge, vec2 first, vec2 span, float snap) {
  return beyond(p, edge, first, span) - snap * (abs(edge.x) + abs(edge.y));
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, vec2 samples, float snap) {
  vec2 low = min(min(a, b), c), high = max(max(a, b), c);
  vec2 first = max(ceil(low - snap), 0.0), last = min(floor(high + snap), samples - 1.0), span = last - first;
  vec2 size = high - low, ab = b - a, bc = c - b, ca = a - c;
  bool seen = span.x >= 0 && span.y >= 0 && cross2(ab, bc) <= 4 * snap * (size.x + size.y + snap);
  bool small = span.x <= 1 && span.y <= 1;  // each of its samples is looked at
  vec4 outside = max(max(wellBeyond(a, ab, first, span, snap), wellBeyond(b, bc, first, span, snap)), wellBeyond(c, ca, first, span, snap));
  return high.x >= 0.5 * kBehind || (seen && (!small || min(min(outside.x, outside.y), min(outside.z, outside.w)) <= 0));
}

uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap) {
  return (seenOfTriangle(a, b, c, samples, snap) ? 1u : 0u) | (seenOfTriangle(a, c, d, samples, snap) ? 2u : 0u);
}

#endif
