// What shared/tubes.h keeps in memory, read word by word (lib/words.glsl). Words that nobody uses are not
// loaded.
#ifndef VASA_RECORDS
#define VASA_RECORDS
#include "lib/section.glsl"
#include "shared/tubes.h"

SweepRecord sweepAt(Sweeps sweeps, uint i) {
  uint first = 5 * i;
  uvec2 start = halvesOf(sweeps.word[first]), classes = halvesOf(sweeps.word[first + 1]);
  uvec2 points = halvesOf(sweeps.word[first + 2]), vessel = halvesOf(sweeps.word[first + 3]);
  vec2 range = vec2Of(sweeps.word[first + 4]);
  return SweepRecord(start.x, start.y, classes.x, classes.y, points.x, points.y, vessel.x, vessel.y, range.x, range.y);
}

// Its other elements are 0 (bezierOf()).
mat4 spanClassAt(Tables tables, uint spanClass) {
  uint first = 8 * spanClass;
  mat4 m = mat4(0);
  m[0][0] = vec2Of(tables.word[first]).x;
  m[1] = vec4(vec2Of(tables.word[first + 2]), vec2Of(tables.word[first + 2 + 1]));
  m[2] = vec4(vec2Of(tables.word[first + 4]), vec2Of(tables.word[first + 4 + 1]));
  m[3][3] = vec2Of(tables.word[first + 7]).y;
  return m;
}

Bezier spanAt(Points points, Tables tables, uint point, uint spanClass) {
  return bezierOf(spanClassAt(tables, spanClass), vec4Of(points.point[point]), vec4Of(points.point[point + 1]),
                  vec4Of(points.point[point + 2]), vec4Of(points.point[point + 3]));
}

vec3 chordOf(Points points, uint first, uint last) {
  return vec4Of(points.point[last]).xyz - vec4Of(points.point[first]).xyz;
}

void writeTriangle(UintsOut indices, uint first, uvec3 triangle) {
  indices.value[first] = triangle.x;
  indices.value[first + 1] = triangle.y;
  indices.value[first + 2] = triangle.z;
}

const uint kStepWord = 8 * kSpanClasses, kHalfStepWord = kStepWord + kMaxAround + 1, kPolarWord = kHalfStepWord + kMaxAround + 1,
           kErrorWord = kPolarWord + kCapRings + 1;

vec2 stepAt(Tables tables, uint around) { return vec2Of(tables.word[kStepWord + around]); }
vec2 halfStepAt(Tables tables, uint around) { return vec2Of(tables.word[kHalfStepWord + around]); }
vec2 polarAt(Tables tables, uint i) { return vec2Of(tables.word[kPolarWord + i]); }

float aroundErrorAt(Tables tables, uint around) { return vec2Of(tables.word[kErrorWord + around / 2])[around & 1]; }

DetailView viewAt(View view) {
  DetailView v;
  for (uint i = 0; i < 3; ++i) v.picture[i] = vec4(vec2Of(view.word[2 * i]), vec2Of(view.word[2 * i + 1]));
  for (uint i = 0; i < 5; ++i) v.planes[i] = vec4(vec2Of(view.word[6 + 2 * i]), vec2Of(view.word[6 + 2 * i + 1]));
  v.depth = vec4(vec2Of(view.word[16]), vec2Of(view.word[16 + 1]));
  vec4 scale = vec4(vec2Of(view.word[18]), vec2Of(view.word[18 + 1]));
  v.nearest = scale.x, v.reach = scale.y, v.focal = scale.z, v.tolerance = scale.w;
  uvec2 quads = halvesOf(view.word[20]), kinds = halvesOf(view.word[21]);
  v.around = quads.x, v.along = quads.y, v.hiddenKinds = kinds.x, v.columns = uintBitsToFloat(kinds.y);
  vec2 rows = vec2Of(view.word[22]);
  v.rows = rows.x, v.snap = rows.y, v.samples = halvesOf(view.word[23]).x;
  return v;
}

#endif
