// Mirrors engine/surface/fork_template.cpp. The shader that includes it has  void add(uint a, uint b, uint c).
#ifndef VASA_FORK_TRIANGLES
#define VASA_FORK_TRIANGLES
#include "lib/fork.glsl"

const float kNominalWide = 1.4, kNominalHigh = 1.2;

struct ForkShape {
  uint a, b, branch, window;
};

uint rowSize(ForkShape shape, uint row) { return row < kTrunkRows - 1 ? shape.a : row == kTrunkRows - 1 ? shape.b : shape.branch; }

uint rowStart(ForkShape shape, uint row) {
  return row < kTrunkRows ? row * shape.a : (kTrunkRows - 1) * shape.a + shape.b + (row - kTrunkRows) * shape.branch;
}

float squareWay(vec2 d) {
  precise float way = d.y >= 0 ? (d.x >= 0 ? d.y / (d.x + d.y) : 1.0 - d.x / (d.y - d.x))
                               : (d.x < 0 ? 2.0 + d.y / (d.x + d.y) : 3.0 + d.x / (d.x - d.y));
  return way;
}

void addQuads(ForkShape shape, uint row, uint firstColumn) {
  uint m = rowSize(shape, row), low = rowStart(shape, row), high = rowStart(shape, row + 1);
  for (uint k = firstColumn; k < m; ++k) {
    uint next = k + 1 == m ? 0 : k + 1;
    add(low + k, low + next, high + next);
    add(low + k, high + next, high + k);
  }
}

void addStrip(ForkShape shape, uint row) {
  uint p = rowSize(shape, row), q = rowSize(shape, row + 1);
  if (p == q) {
    addQuads(shape, row, 0);
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

uvec2 outlinePlace(uint i, uint window) {
  if (i == 0) return uvec2(2, window);
  if (i <= window + 1) return uvec2(3, window + 1 - i);
  if (i == window + 2) return uvec2(2, 0);
  return uvec2(1, i - window - 3);
}

uint outlineVertex(ForkShape shape, uint i) {
  uvec2 place = outlinePlace(i, shape.window);
  return rowStart(shape, place.x) + place.y;
}

float outerWay(ForkShape shape, uint i) {
  if (i == 2 * shape.window + 4) return 4.0;
  uvec2 place = outlinePlace(i, shape.window);
  precise float x = kNominalWide * (2.0 * float(place.y) / float(shape.window) - 1.0);
  precise float y = kNominalHigh * (float(place.x) - 2.0);
  return squareWay(vec2(x, y));
}

// `directions` are the branch's.
float holeWay(ForkShape shape, uint i) { return i == shape.branch ? 4.0 : squareWay(directions[i]); }

void addWall(ForkShape shape) {
  uint outline = 2 * shape.window + 4, hole = shape.branch, first = rowStart(shape, kTrunkRows);
  for (uint o = 0, h = 0; o < outline || h < hole;) {
    uint outer = outlineVertex(shape, o == outline ? 0 : o), inner = first + (h == hole ? 0 : h);
    bool outwards = h == hole;
    if (!outwards && o < outline) {
      precise float outerSum = outerWay(shape, o) + outerWay(shape, o + 1);
      precise float holeSum = holeWay(shape, h) + holeWay(shape, h + 1);
      outwards = outerSum <= holeSum;
    }
    if (outwards) {
      ++o;
      add(inner, outer, outlineVertex(shape, o == outline ? 0 : o));
    } else {
      ++h;
      add(inner, outer, first + (h == hole ? 0 : h));
    }
  }
}

void addForkTriangles(ForkShape shape) {
  addQuads(shape, 0, 0);
  addQuads(shape, 1, shape.window);
  addQuads(shape, 2, shape.window);
  addStrip(shape, 3);
  if (shape.window == 0) return;
  addWall(shape);
  for (uint row = kTrunkRows; row < kTrunkRows + kCollarRows; ++row) addQuads(shape, row, 0);
}

#endif
