// Mirrors tests/reference/visible.cpp: may a quad's triangles cover a sample of the picture with their fronts?
#ifndef VASA_VISIBLE
#define VASA_VISIBLE
#include "shared/detail.h"
#include "shared/tubes.h"

// Where a picture is sampled, as engine/surface/detail.h has it.
struct PictureGrid {
  vec2 size;
  float snap;
  uint samples;
};

PictureGrid gridOf(DetailView view) { return PictureGrid(vec2(view.columns, view.rows), view.snap, view.samples); }

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Of samples in their pixels, from the middle: Vulkan's standard places.
vec2 placeOfSample(uint s, uint samples) {
  return samples == 1 ? vec2(0) : vec2(0.5 * float(s & 1u) - (s < 2 ? 0.125 : 0.375), 0.25 * float(s) - 0.375);
}

// How far the area that an edge spans with a sample may move as its ends do.
float movedBy(vec2 along, float snap) { return snap * (abs(along.x) + abs(along.y)); }

// Twice the areas of an edge from p with four samples.
vec4 areasWith(vec2 p, vec2 along, vec2 first, vec2 span) {
  float at = cross2(along, first - p), alongX = -along.y * span.x, alongY = along.x * span.y;
  return vec4(at, at + alongX, at + alongY, at + alongX + alongY);
}

bool within(float p, float q, float r, vec3 moved) { return all(lessThanEqual(vec3(p, q, r), moved)); }

// Whether any of four samples lies behind three edges, or hardly before them: it does so at areas below 0, as y points down.
// In truth values: a CPU device takes three instructions for the larger one of two numbers.
bool anyWithin(vec4 p, vec4 q, vec4 r, vec3 moved) {
  return any(bvec4(within(p.x, q.x, r.x, moved), within(p.y, q.y, r.y, moved), within(p.z, q.z, r.z, moved),
                   within(p.w, q.w, r.w, moved)));
}

// Both triangles at once, in the box of the quad: what they share is nearly half of the work.
uint seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, PictureGrid grid) {
  vec2 low = min(min(a, d), min(b, c)) - grid.snap, high = max(max(a, d), max(b, c)) + grid.snap, reach = high - low;
  vec2 ab = b - a, bc = c - b, ac = c - a, cd = d - c, da = a - d;
  float snap = grid.snap, backs = 4 * snap * (reach.x + reach.y);
  vec3 moved = vec3(movedBy(ab, snap), movedBy(bc, snap), movedBy(ac, snap));
  vec3 movedToo = vec3(movedBy(cd, snap), movedBy(da, snap), moved.z);
  bool abc = false, acd = false;
  for (uint s = 0; s < grid.samples; ++s) {
    vec2 place = placeOfSample(s, grid.samples);
    vec2 first = max(ceil(low - place), 0.0), span = min(floor(high - place), grid.size - 1.0) - first, from = first + place;
    vec4 diagonal = areasWith(a, ac, from, span);
    bool any = span.x >= 0 && span.y >= 0, large = span.x > 1 || span.y > 1;  // else each of its samples is looked at
    abc = abc || any && (large || anyWithin(areasWith(a, ab, from, span), areasWith(b, bc, from, span), -diagonal, moved));
    acd = acd || any && (large || anyWithin(areasWith(c, cd, from, span), areasWith(d, da, from, span), diagonal, movedToo));
  }
  uint fronts = (cross2(ab, bc) <= backs ? 1u : 0u) | (cross2(ac, cd) <= backs ? 2u : 0u);
  return high.x >= 0.5 * kBehind ? 3u : fronts & ((abc ? 1u : 0u) | (acd ? 2u : 0u));
}

#endif
