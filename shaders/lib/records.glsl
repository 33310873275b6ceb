// What shared/tubes.h keeps in memory, read by words of 64 bits: a CPU device goes round all lanes for every word it loads.
// Words that nobody uses are not loaded.
#ifndef VASA_RECORDS
#define VASA_RECORDS
#include "lib/words.glsl"
#include "shared/tubes.h"

vec2 vec2At(Words words, uint i) { return uintBitsToFloat(halvesOf(words.word[i])); }
vec4 vec4At(Words words, uint i) { return vec4(vec2At(words, i), vec2At(words, i + 1)); }

SweepRecord sweepAt(Sweeps sweeps, uint i) {
  Words words = Words(sweeps);
  uint first = 5 * i;
  uvec2 start = halvesOf(words.word[first]), classes = halvesOf(words.word[first + 1]);
  uvec2 points = halvesOf(words.word[first + 2]), vessel = halvesOf(words.word[first + 3]);
  vec2 range = vec2At(words, first + 4);
  return SweepRecord(start.x, start.y, classes.x, classes.y, points.x, points.y, vessel.x, vessel.y, range.x, range.y);
}

// Its other elements are 0 (bezierOf()).
mat4 spanClassAt(Tables tables, uint spanClass) {
  Words words = Words(tables);
  uint first = 8 * spanClass;
  mat4 m = mat4(0);
  m[0][0] = vec2At(words, first).x;
  m[1] = vec4At(words, first + 2);
  m[2] = vec4At(words, first + 4);
  m[3][3] = vec2At(words, first + 7).y;
  return m;
}

const uint kStepWord = 8 * kSpanClasses, kHalfStepWord = kStepWord + kMaxAround + 1, kPolarWord = kHalfStepWord + kMaxAround + 1;

vec2 stepAt(Tables tables, uint around) { return vec2At(Words(tables), kStepWord + around); }
vec2 halfStepAt(Tables tables, uint around) { return vec2At(Words(tables), kHalfStepWord + around); }
vec2 polarAt(Tables tables, uint i) { return vec2At(Words(tables), kPolarWord + i); }

DetailView viewAt(View view) {
  Words words = Words(view);
  DetailView v;
  for (uint i = 0; i < 3; ++i) v.picture[i] = vec4At(words, 2 * i);
  for (uint i = 0; i < 5; ++i) v.planes[i] = vec4At(words, 6 + 2 * i);
  v.depth = vec4At(words, 16);
  vec4 scale = vec4At(words, 18);
  v.nearest = scale.x, v.reach = scale.y, v.focal = scale.z, v.tolerance = scale.w;
  uvec2 quads = halvesOf(words.word[20]), kinds = halvesOf(words.word[21]);
  v.around = quads.x, v.along = quads.y, v.hiddenKinds = kinds.x, v.columns = uintBitsToFloat(kinds.y);
  vec2 last = vec2At(words, 22);
  v.rows = last.x, v.snap = last.y;
  return v;
}

#endif
