// Mirrors engine/surface/fork_template.cpp, and smoothFolds() of fork_stump.cpp.
#ifndef VASA_FORK_TRIANGLES
#define VASA_FORK_TRIANGLES
#include "lib/fork_smooth.glsl"

bool stumps[kMostBranches], cut;   // parts that are stumps

bool inWindow(ForkShape shape, uint column) {
  bool found = false;
  for (uint i = 0; i < kMostBranches; ++i) {
    uint first = windows[i].first, behind = column < first ? column + shape.a - first : column - first;
    found = found || (i < shape.branchCount && !stumps[i] && behind < windows[i].count);
  }
  return found;
}

void addQuads(ForkShape shape, uint row, bool aroundWindows) {
  uint m = rowSize(shape, row), low = rowStart(shape, row), high = rowStart(shape, row + 1), k = 0;
  Corner a = cornerAt(low), d = cornerAt(high);
  do {
    uint next = k + 1 == m ? 0 : k + 1;
    Corner b = cornerAt(low + next), c = cornerAt(high + next);
    if (!aroundWindows || !inWindow(shape, k)) addQuad(a, b, c, d);
    a = b;
    d = c;
  } while (++k < m);
}

// Between rows that differ in their vertices.
void addUneven(ForkShape shape, uint row) {
  uint p = rowSize(shape, row), q = rowSize(shape, row + 1);
  uint low = rowStart(shape, row), high = rowStart(shape, row + 1), i = 0, k = 0;
  Corner a = cornerAt(low), b = cornerAt(high);
  do {
    bool lower = k == q || (i < p && (2 * i + 1) * q <= (2 * k + 1) * p);
    Corner alongLow = cornerAt(low + (i + 1 >= p ? 0 : i + 1)), alongHigh = cornerAt(high + (k + 1 >= q ? 0 : k + 1));
    if (addEither(b, a, alongLow, alongHigh, lower, i < p && k < q)) {
      ++i;
      a = alongLow;
    } else {
      ++k;
      b = alongHigh;
    }
  } while (i < p || k < q);
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

void addStumpQuads(ForkShape shape, uint row) {
  uint m = rowSize(shape, row), low = rowStart(shape, row), high = rowStart(shape, row + 1);
  for (uint k = 0; k < m; ++k) {
    uint next = k + 1 == m ? 0 : k + 1;
    addPiece(low + k, low + next, high + next, high + k);
  }
}

// A stump's vertices are not there yet: all of its triangles are drawn. The trunk has one at either end.
void addStumpTriangles(ForkShape shape, bool trunk, uint branch) {
  uint ring = branchRow(branch);
  addStumpQuads(shape, trunk ? 0 : ring - 1);
  if (trunk) addTipOfFirst(shape, 1);
  addTipOfLast(shape, trunk ? kTrunkRows - 2 : ring - 2);
}

// All triangles, and which parts fold: a bit a branch, then one for the trunk, whose wall has holes for branches that are
// no stumps. One loop for all parts: a device compiles what it calls once for each place that calls it.
uint addParts(ForkShape shape) {
  uint wrong = 0;
  pieces = triangles = 0;
  for (uint part = 0; part <= shape.branchCount; ++part) {
    bool trunk = part == shape.branchCount;
    folded = false;
    if (cut || (!trunk && stumps[min(part, kMostBranches - 1)])) {
      addStumpTriangles(shape, trunk, part);
    } else {
      uint first = trunk ? 0 : holeRow(part), last = trunk ? kTrunkRows - 1 : branchRow(part);
      if (!trunk) addWall(shape, part);
      bool uneven = trunk && shape.a != shape.b;  // the last strip
      for (uint row = first; row + uint(uneven) < last; ++row) addQuads(shape, row, trunk && (row == 1 || row == 2));
      if (uneven) addUneven(shape, last - 1);
    }
    if (folded) wrong |= 1u << (trunk ? kMostBranches : part);
  }
  return wrong;
}

void smoothParts(ForkShape shape, uint wrong) {
  for (uint part = 0; part <= shape.branchCount; ++part) {
    bool trunk = part == 0;
    if ((wrong >> (trunk ? kMostBranches : part - 1) & 1u) == 0u) continue;
    if (!trunk) smoothHole(shape, part - 1);
    smoothRows(shape, trunk ? 0 : holeRow(part - 1), trunk ? kTrunkRows - 1 : branchRow(part - 1));
  }
}

// Parts that fold are smoothed; branches that fold yet become stumps, and then everything, where the trunk does.
void addForkTriangles(ForkShape shape) {
  cut = false;
  for (uint i = 0; i < kMostBranches; ++i) stumps[i] = false;
  uint wrong = 0;
  for (uint step = 0; step <= kMostSmoothings + 2; ++step) {
    cut = step > kMostSmoothings + 1;
    if (step <= kMostSmoothings) smoothParts(shape, wrong);
    else for (uint i = 0; i < shape.branchCount; ++i) stumps[i] = cut || (wrong >> i & 1u) != 0u;
    wrong = addParts(shape);
    if (wrong == 0) break;
  }
}

#endif
