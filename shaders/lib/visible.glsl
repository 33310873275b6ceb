// Mirrors engine/surface/visible.cpp: may a quad's triangles cover a sample of the picture with their fronts?
#ifndef VASA_VISIBLE
#define VASA_VISIBLE
#include "shared/detail.h"
#include "shared/tubes.h"

// Where a picture is sampled, as engine/surface/visible.h has it.
struct PictureGrid {
  vec2 size;
  float snap;
  uint samples;
};

PictureGrid gridOf(DetailView view) { return PictureGrid(vec2(view.columns, view.rows), view.snap, view.samples); }

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

// Of the s-th of so many samples in its pixel, from the middle: Vulkan's standard places.
vec2 placeOfSample(uint s, uint samples) {
  return samples == 1 ? vec2(0) : vec2(0.5 * float(s & 1u) - (s < 2 ? 0.125 : 0.375), 0.25 * float(s) - 0.375);
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, PictureGrid grid) {
  float snap = grid.snap;
  vec2 low = min(min(a, b), c) - snap, high = max(max(a, b), c) + snap, reach = high - low;
  Edge ab = edgeOf(a, b, snap), bc = edgeOf(b, c, snap), ca = edgeOf(c, a, snap);
  bool front = cross2(ab.along, bc.along) <= 4 * snap * (reach.x + reach.y), seen = high.x >= 0.5 * kBehind;
  for (uint s = 0; s < grid.samples && front && !seen; ++s)
    seen = mayCover(ab, bc, ca, low, high, grid.size, placeOfSample(s, grid.samples));
  return seen;
}

// One loop for both triangles: a device compiles what is called once for each place that calls it.
uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, PictureGrid grid) {
  uint seen = 0;
  for (uint i = 0; i < 2; ++i)
    seen |= seenOfTriangle(a, i == 0 ? b : c, i == 0 ? c : d, grid) ? 1u << i : 0u;
  return seen;
}

#endif
