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

// A vertex: x and y, z and the normal's x, its y and z. Arrays are as short as can be, of words as wide as can be: a CPU
// device compiles each access lane by lane and word by word, and clears arrays word by word, in a time that grows as the
// square of their number.
struct CornerWords {
  Word a, b, c;
};

CornerWords corners[kMostForkVertices];
uint list[kMostForkPieces];  // of quads, 8 bits a corner: triangles abc and acd, or abc alone where d is a
uint pieces, triangles;      // how many are in the list, and triangles in all of them
bool folded;                 // some triangle that was added folds

SurfacePoint cornerOf(uint vertex) {
  CornerWords words = corners[vertex];
  vec2 a = vec2Of(words.a), b = vec2Of(words.b);
  return SurfacePoint(vec3(a, b.x), vec3(b.y, vec2Of(words.c)));
}

vec3 positionOf(uint vertex) { return vec3(vec2Of(corners[vertex].a), vec2Of(corners[vertex].b).x); }

void put(uint vertex, SurfacePoint point) {
  corners[vertex] = CornerWords(wordOf(point.position.xy), wordOf(vec2(point.position.z, point.normal.x)), wordOf(point.normal.yz));
}

// A vertex as the triangles around it need it: loads from an array cost a CPU device more than what is done with them.
struct Corner {
  uint vertex;
  SurfacePoint point;
};

Corner cornerAt(uint vertex) { return Corner(vertex, cornerOf(vertex)); }

bool folds(SurfacePoint a, SurfacePoint b, SurfacePoint c) {
  precise vec3 first = b.position - a.position, second = c.position - a.position;
  precise vec3 normals = a.normal + b.normal + c.normal;
  float along = dotOf(crossOf(first, second), normals);
  precise float square = along * along;
  precise float flat2 = kFlat2 * dotOf(first, first) * dotOf(second, second);
  return along <= 0 || square <= flat2;
}

void addPiece(uint a, uint b, uint c, uint d) {
  list[pieces++] = a | b << 8 | c << 16 | d << 24;
  triangles += d == a ? 1 : 2;
}

void add(uint a, uint b, uint c) { addPiece(a, b, c, a); }

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
  addPiece(other ? b.vertex : a.vertex, other ? c.vertex : b.vertex, other ? d.vertex : c.vertex, other ? a.vertex : d.vertex);
}

#endif
