// Mirrors engine/surface/fork_smooth.cpp: the same operations in the same order.
#ifndef VASA_FORK_SMOOTH
#define VASA_FORK_SMOOTH
#include "lib/fork_wall.glsl"

const float kStep = 0.5;                         // of the way to the neighbours' mean
const float kNormalStep = 1.0, kSeamStep = 0.3;  // weight of the surface's own normal: within, and beside other parts

// The vertex of a row beside place k of m.
uint besideIn(ForkShape shape, uint row, uint k, uint m) {
  uint own = rowSize(shape, row), at = own == m ? k : (k * own + m / 2) / m;
  return rowStart(shape, row) + (at == own ? 0 : at);
}

void moveTo(uint vertex, uint a, uint b, uint c, uint d) {
  SurfacePoint point = cornerOf(vertex);
  precise vec3 p = point.position;
  precise vec3 moved = p + kStep * (0.25 * (positionOf(a) + positionOf(b) + positionOf(c) + positionOf(d)) - p);
  put(vertex, SurfacePoint(moved, point.normal));
}

void smoothRows(ForkShape shape, uint first, uint last) {
  for (uint row = first + 1; row < last; ++row) {
    uint m = rowSize(shape, row), start = rowStart(shape, row);
    for (uint k = 0; k < m; ++k)
      moveTo(start + k, start + (k + 1 == m ? 0 : k + 1), start + (k == 0 ? m : k) - 1, besideIn(shape, row - 1, k, m),
             besideIn(shape, row + 1, k, m));
  }
  for (uint row = first; row <= last; ++row) {
    uint m = rowSize(shape, row), start = rowStart(shape, row);
    uint before = row == first ? row : row - 1, after = row == last ? row : row + 1;
    float share = before == row || after == row ? kSeamStep : kNormalStep;
    for (uint k = 0; k < m; ++k) {
      precise vec3 around = positionOf(start + (k + 1 == m ? 0 : k + 1)) - positionOf(start + (k == 0 ? m : k) - 1);
      precise vec3 along = positionOf(besideIn(shape, after, k, m)) - positionOf(besideIn(shape, before, k, m));
      SurfacePoint point = cornerOf(start + k);
      precise vec3 normal = point.normal + share * unitOr(crossOf(around, along), point.normal);
      put(start + k, SurfacePoint(point.position, unitOr(normal, point.normal)));
    }
  }
}

void smoothHole(ForkShape shape, uint branch) {
  ForkWindow window = windows[branch];
  uint m = shape.branch[branch], hole = rowStart(shape, holeRow(branch)), outline = 2 * window.count + 4;
  for (uint k = 0; k < m; ++k) {
    uint outer = (k * outline + m / 2) / m;
    moveTo(hole + k, hole + (k + 1 == m ? 0 : k + 1), hole + (k == 0 ? m : k) - 1,
           outlineVertex(shape, window, outer == outline ? 0 : outer), hole + m + k);
  }
}

#endif
