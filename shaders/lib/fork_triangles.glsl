// Mirrors engine/surface/fork_template.cpp. The shader that includes it has
//   vec2 stepOf(uint around)           (cos, sin) of 2π/m
#ifndef VASA_FORK_TRIANGLES
#define VASA_FORK_TRIANGLES
#include "lib/fork.glsl"

// Columns between which a hole lies, and how it lies there.
struct ForkWindow {
  uint first, count;
  vec2 hole;
  float wide;
  vec3 rows;
};

struct ForkShape {
  uint a, b, branchCount;
  uint branch[kMostBranches];
};

const uint kBranchRows = 1 + kCollarRows;

ForkWindow windows[kMostBranches];
bool stumps[kMostBranches], cut;   // parts that are stumps
uint list[kMostForkTriangles];     // of triangles, 8 bits a corner
uint triangles;                    // how many
vec2 columns[kMaxAround];  // the trunk's directions

uint holeRow(uint branch) { return kTrunkRows + branch * kBranchRows; }
uint branchRow(uint branch) { return holeRow(branch) + kCollarRows; }

uint rowSize(ForkShape shape, uint row) {
  if (row < kTrunkRows) return row + 1 < kTrunkRows ? shape.a : shape.b;
  return shape.branch[(row - kTrunkRows) / kBranchRows];
}

uint rowStart(ForkShape shape, uint row) {
  if (row < kTrunkRows) return row * shape.a;
  uint start = (kTrunkRows - 1) * shape.a + shape.b, rest = row - kTrunkRows;
  if (rest <= kBranchRows) return start + rest * shape.branch[0];
  return start + kBranchRows * shape.branch[0] + (rest - kBranchRows) * shape.branch[1];
}

void add(uint a, uint b, uint c) { list[triangles++] = a | b << 8 | c << 16; }
uvec3 triangleAt(uint i) { return uvec3(list[i], list[i] >> 8, list[i] >> 16) & 255u; }

bool inWindow(ForkShape shape, uint column) {
  for (uint i = 0; i < shape.branchCount; ++i)
    if (!stumps[i] && (column + shape.a - windows[i].first) % shape.a < windows[i].count) return true;
  return false;
}

float squareWay(vec2 d) {
  precise float way = d.y >= 0 ? (d.x >= 0 ? d.y / (d.x + d.y) : 1.0 - d.x / (d.y - d.x))
                               : (d.x < 0 ? 2.0 + d.y / (d.x + d.y) : 3.0 + d.x / (d.x - d.y));
  return way;
}

void addQuads(ForkShape shape, uint row, bool aroundWindows) {
  uint m = rowSize(shape, row), low = rowStart(shape, row), high = rowStart(shape, row + 1);
  for (uint k = 0; k < m; ++k) {
    if (aroundWindows && inWindow(shape, k)) continue;
    uint next = k + 1 == m ? 0 : k + 1;
    add(low + k, low + next, high + next);
    add(low + k, high + next, high + k);
  }
}

void addStrip(ForkShape shape, uint row) {
  uint p = rowSize(shape, row), q = rowSize(shape, row + 1);
  if (p == q) {
    addQuads(shape, row, false);
    return;
  }
  uint low = rowStart(shape, row), high = rowStart(shape, row + 1);
  for (uint i = 0, k = 0; i < p || k < q;) {
    uint a = low + (i == p ? 0 : i), b = high + (k == q ? 0 : k);
    if (k == q || (i < p && (2 * i + 1) * q <= (2 * k + 1) * p)) {
      ++i;
      add(a, low + (i == p ? 0 : i), b);
    } else {
      ++k;
      add(a, high + (k == q ? 0 : k), b);
    }
  }
}

uvec2 outlinePlace(uint i, uint count) {
  if (i == 0) return uvec2(2, count);
  if (i <= count + 1) return uvec2(3, count + 1 - i);
  if (i == count + 2) return uvec2(2, 0);
  return uvec2(1, i - count - 3);
}

uint outlineVertex(ForkShape shape, ForkWindow window, uint i) {
  uvec2 place = outlinePlace(i, window.count);
  return rowStart(shape, place.x) + (window.first + place.y) % shape.a;
}

float outlineWay(ForkShape shape, ForkWindow window, uint i) {
  uvec2 place = outlinePlace(i, window.count);
  vec2 column = columns[(window.first + place.y) % shape.a];
  precise float along = column.x * window.hole.x + column.y * window.hole.y;
  precise float aside = column.y * window.hole.x - column.x * window.hole.y;
  precise float x = 2.0 * aside / ((1.0 + max(along, -0.99)) * window.wide);
  return squareWay(vec2(x, window.rows[place.x - 1]));
}

float outerWay(ForkShape shape, ForkWindow window, float start, uint i) {
  return i == 0 ? start : i == 2 * window.count + 4 ? start + 4.0 : outlineWay(shape, window, i);
}

// `directions` have to be the branch's.
float holeWay(uint hole, uint i) { return i == hole ? 4.0 : squareWay(directions[i]); }

void addWall(ForkShape shape, uint branch) {
  ForkWindow window = windows[branch];
  uint outline = 2 * window.count + 4, hole = shape.branch[branch], first = rowStart(shape, holeRow(branch));
  float start = outlineWay(shape, window, 0);
  if (start > 2) start -= 4.0;
  for (uint o = 0, h = 0; o < outline || h < hole;) {
    uint outer = outlineVertex(shape, window, o == outline ? 0 : o), inner = first + (h == hole ? 0 : h);
    bool outwards = h == hole;
    if (!outwards && o < outline) {
      precise float outerSum = outerWay(shape, window, start, o) + outerWay(shape, window, start, o + 1);
      precise float holeSum = holeWay(hole, h) + holeWay(hole, h + 1);
      outwards = outerSum <= holeSum;
    }
    if (outwards) {
      ++o;
      add(inner, outer, outlineVertex(shape, window, o == outline ? 0 : o));
    } else {
      ++h;
      add(inner, outer, first + (h == hole ? 0 : h));
    }
  }
}

// A stump's tip in the row behind its wide one, or before it.
void addTipOfFirst(ForkShape shape, uint row) {
  uint m = rowSize(shape, row), low = rowStart(shape, row), tip = rowStart(shape, row + 1);
  for (uint k = 0; k < m; ++k) add(low + k, low + (k + 1 == m ? 0 : k + 1), tip + k);
}

void addTipOfLast(ForkShape shape, uint row) {
  uint m = rowSize(shape, row + 1), tip = rowStart(shape, row), high = rowStart(shape, row + 1), tips = rowSize(shape, row);
  for (uint k = 0; k < m; ++k) add(tip + k * tips / m, high + (k + 1 == m ? 0 : k + 1), high + k);
}

void addTrunk(ForkShape shape) {
  addQuads(shape, 0, false);
  if (cut) {
    addTipOfFirst(shape, 1);
    addTipOfLast(shape, kTrunkRows - 2);
  } else {
    addQuads(shape, 1, true);
    addQuads(shape, 2, true);
    addStrip(shape, 3);
  }
}

void addBranch(ForkShape shape, uint branch) {
  uint ring = branchRow(branch);
  if (stumps[branch]) {
    addTipOfLast(shape, ring - 2);
    addQuads(shape, ring - 1, false);
    return;
  }
  setDirections(stepOf(shape.branch[branch]), shape.branch[branch]);
  addWall(shape, branch);
  for (uint row = holeRow(branch); row < ring; ++row) addQuads(shape, row, false);
}

#endif
