// A fork's rows of vertices and the list of its triangles. Mirrors parts of engine/surface/fork_template.cpp and
// fork_check.cpp: the same operations in the same order.
#ifndef VASA_FORK_ROWS
#define VASA_FORK_ROWS
#include "lib/fork.glsl"

struct ForkShape {
  uint a, b, branchCount;
  uint branch[kMostBranches];
};

const uint kBranchRows = 1 + kCollarRows;

uint holeRow(uint branch) { return kTrunkRows + branch * kBranchRows; }
uint branchRow(uint branch) { return holeRow(branch) + kCollarRows; }

uint rowSize(ForkShape shape, uint row) {
  if (row < kTrunkRows) return row + 1 < kTrunkRows ? shape.a : shape.b;
  return row < kTrunkRows + kBranchRows ? shape.branch[0] : shape.branch[1];
}

uint rowStart(ForkShape shape, uint row) {
  if (row < kTrunkRows) return row * shape.a;
  uint start = (kTrunkRows - 1) * shape.a + shape.b, rest = row - kTrunkRows;
  if (rest <= kBranchRows) return start + rest * shape.branch[0];
  return start + kBranchRows * shape.branch[0] + (rest - kBranchRows) * shape.branch[1];
}

const float kFlat2 = 1e-10;  // square of the share of its edges that a triangle looks the right way

SurfacePoint corners[kMostForkVertices];
uint list[kMostForkTriangles];   // of triangles, 8 bits a corner
uint triangles;                  // how many
bool folded;                     // some triangle that was added folds

// A vertex as the triangles around it need it: loads from an array cost a CPU device more than what is done with them.
struct Corner {
  uint vertex;
  SurfacePoint point;
};

Corner cornerAt(uint vertex) { return Corner(vertex, corners[vertex]); }

bool folds(SurfacePoint a, SurfacePoint b, SurfacePoint c) {
  precise vec3 first = b.position - a.position, second = c.position - a.position;
  precise vec3 normals = a.normal + b.normal + c.normal;
  float along = dotOf(crossOf(first, second), normals);
  precise float square = along * along;
  precise float flat2 = kFlat2 * dotOf(first, first) * dotOf(second, second);
  return along <= 0 || square <= flat2;
}

void add(uint a, uint b, uint c) { list[triangles++] = a | b << 8 | c << 16; }

bool foldsAt(Corner a, Corner b, Corner c) { return folds(a.point, b.point, c.point); }

// The triangle on an edge from a to b whose third corner is c or d, as `first` has it, or, if both are to be had, the other
// where only that does not fold. @return whether it is c
bool addEither(Corner a, Corner b, Corner c, Corner d, bool first, bool both) {
  bool one = foldsAt(a, b, c), other = foldsAt(a, b, d);
  if (both && one != other) first = other;
  folded = folded || (first ? one : other);
  add(a.vertex, b.vertex, first ? c.vertex : d.vertex);
  return first;
}

// Cut in two from a to c, or from b to d where only that does not fold.
void addQuad(Corner a, Corner b, Corner c, Corner d) {
  bool first = foldsAt(a, b, c) || foldsAt(a, c, d), other = first && !foldsAt(b, c, d) && !foldsAt(b, d, a);
  folded = folded || (first && !other);
  add(other ? b.vertex : a.vertex, other ? c.vertex : b.vertex, other ? d.vertex : c.vertex);
  add(other ? b.vertex : a.vertex, other ? d.vertex : c.vertex, other ? a.vertex : d.vertex);
}

#endif
