// Triangles of a trunk's wall around a branch's hole. Mirrors parts of engine/surface/fork_template.cpp.
#ifndef VASA_FORK_WALL
#define VASA_FORK_WALL
#include "lib/fork_rows.glsl"

// Columns between which a hole lies, and how it lies there.
struct ForkWindow {
  uint first, count;
  vec2 hole;
  float wide;
  vec3 rows;
};

ForkWindow windows[kMostBranches];

// Below 2 m; a CPU device divides whole numbers lane by lane.
uint wrapped(uint k, uint m) { return k < m ? k : k - m; }

// By quarters of a square around the origin, from direction x on.
float squareWay(vec2 d) {
  bool up = d.y >= 0, right = d.x >= 0;
  bool direct = up ? right : d.x < 0;  // y over x, else x over y
  float base = up ? (right ? 0.0 : 1.0) : (direct ? 2.0 : 3.0);
  precise float below = direct ? d.x + d.y : up ? d.y - d.x : d.x - d.y;
  precise float part = (direct ? d.y : d.x) / below;
  precise float way = base + (up && !right ? -part : part);
  return way;
}

uvec2 outlinePlace(uint i, uint count) {
  if (i == 0) return uvec2(2, count);
  if (i <= count + 1) return uvec2(3, count + 1 - i);
  if (i == count + 2) return uvec2(2, 0);
  return uvec2(1, i - count - 3);
}

uint outlineVertex(ForkShape shape, ForkWindow window, uint i) {
  uvec2 place = outlinePlace(i, window.count);
  return place.x * shape.a + wrapped(window.first + place.y, shape.a);
}

float outlineWay(ForkShape shape, ForkWindow window, uint i) {
  uvec2 place = outlinePlace(i, window.count);
  vec2 column = directionAt(0, wrapped(window.first + place.y, shape.a));
  precise float along = column.x * window.hole.x + column.y * window.hole.y;
  precise float aside = column.y * window.hole.x - column.x * window.hole.y;
  precise float x = 2.0 * aside / ((1.0 + max(along, -0.99)) * window.wide);
  return squareWay(vec2(x, place.x == 1 ? window.rows.x : place.x == 2 ? window.rows.y : window.rows.z));
}

float outerWay(ForkShape shape, ForkWindow window, float start, uint i) {
  return i == 2 * window.count + 4 ? start + 4.0 : outlineWay(shape, window, i);
}

float holeWay(uint branch, uint hole, uint i) { return i == hole ? 4.0 : squareWay(directionAt(2 + branch, i)); }

// Both fronts keep abreast: by the middles of their next steps.
void addWall(ForkShape shape, uint branch) {
  ForkWindow window = windows[branch];
  uint outline = 2 * window.count + 4, hole = shape.branch[branch], first = rowStart(shape, holeRow(branch));
  float start = outlineWay(shape, window, 0);
  if (start > 2) start -= 4.0;
  uint o = 0, h = 0;
  Corner outer = cornerAt(outlineVertex(shape, window, 0)), inner = cornerAt(first);
  float outerFrom = start, outerTo = outlineWay(shape, window, 1), holeFrom = holeWay(branch, hole, 0), holeTo = holeWay(branch, hole, 1);
  do {
    precise float outerSum = outerFrom + outerTo, holeSum = holeFrom + holeTo;
    bool outwards = h == hole || (o < outline && outerSum <= holeSum);
    Corner alongOuter = cornerAt(outlineVertex(shape, window, o + 1 >= outline ? 0 : o + 1));
    Corner alongInner = cornerAt(first + (h + 1 >= hole ? 0 : h + 1));
    outwards = addEither(inner, outer, alongOuter, alongInner, outwards, o < outline && h < hole);
    float way = outwards ? outerWay(shape, window, start, min(o + 2, outline)) : holeWay(branch, hole, min(h + 2, hole));
    if (outwards) {
      ++o;
      outer = alongOuter;
      outerFrom = outerTo;
      outerTo = way;
    } else {
      ++h;
      inner = alongInner;
      holeFrom = holeTo;
      holeTo = way;
    }
  } while (o < outline || h < hole);
}

#endif
