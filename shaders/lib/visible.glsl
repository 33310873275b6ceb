// Mirrors engine/surface/visible.cpp: may a quad's triangles cover a sample of the picture with their fronts?
#ifndef VASA_VISIBLE
#define VASA_VISIBLE
#include "shared/tubes.h"

layout(constant_id = 0) const uint kSamples = 1;  // a pixel: 1 or 4

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// An edge from p, and how far the area that it spans with a sample may move as its ends do.
struct Edge {
  vec2 p, along;
  float moved;
};

Edge edgeOf(vec2 p, vec2 q, float snap) { return Edge(p, q - p, snap * (abs(q.x - p.x) + abs(q.y - p.y))); }

// Twice the areas of the edge with four samples: above 0 well beyond the edge of a front, as y points down.
vec4 wellBeyond(Edge edge, vec2 first, vec2 span) {
  float at = cross2(edge.along, first - edge.p) - edge.moved, alongX = -edge.along.y * span.x, alongY = edge.along.x * span.y;
  return vec4(at, at + alongX, at + alongY, at + alongX + alongY);
}

// @param low, high  of the box that holds the triangle, however its corners move
// @param place      of the samples in their pixels, from the middle
bool mayCover(Edge ab, Edge bc, Edge ca, vec2 low, vec2 high, vec2 size, vec2 place) {
  vec2 first = max(ceil(low - place), 0.0), last = min(floor(high - place), size - 1.0), span = last - first;
  vec2 from = first + place;
  vec4 outside = max(max(wellBeyond(ab, from, span), wellBeyond(bc, from, span)), wellBeyond(ca, from, span));
  bool small = span.x <= 1 && span.y <= 1;  // each of its samples is looked at
  return span.x >= 0 && span.y >= 0 && (!small || min(min(outside.x, outside.y), min(outside.z, outside.w)) <= 0);
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, vec2 size, float snap) {
  vec2 low = min(min(a, b), c) - snap, high = max(max(a, b), c) + snap, reach = high - low;
  Edge ab = edgeOf(a, b, snap), bc = edgeOf(b, c, snap), ca = edgeOf(c, a, snap);
  bool front = cross2(ab.along, bc.along) <= 4 * snap * (reach.x + reach.y), covers;
  if (kSamples == 1) {
    covers = mayCover(ab, bc, ca, low, high, size, vec2(0));
  } else {  // Vulkan's standard places
    covers = mayCover(ab, bc, ca, low, high, size, vec2(-0.125, -0.375)) ||
             mayCover(ab, bc, ca, low, high, size, vec2(0.375, -0.125)) ||
             mayCover(ab, bc, ca, low, high, size, vec2(-0.375, 0.125)) ||
             mayCover(ab, bc, ca, low, high, size, vec2(0.125, 0.375));
  }
  return high.x >= 0.5 * kBehind || (front && covers);
}

uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 size, float snap) {
  return (seenOfTriangle(a, b, c, size, snap) ? 1u : 0u) | (seenOfTriangle(a, c, d, size, snap) ? 2u : 0u);
}

#endif
