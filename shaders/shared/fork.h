// Read by C++ and GLSL (std430): how a network's forks lie in memory.
#ifndef VASA_SHARED_FORK_H
#define VASA_SHARED_FORK_H
#include "shared/tubes.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Rows of a fork's trunk, both rings of its tubes included.
VASA_CONSTANT uint kTrunkRows = 5;
/// Rows of its collar, without the loop where it leaves the trunk, with the branch's ring.
VASA_CONSTANT uint kCollarRows = 4;
/// Most branches of one fork.
VASA_CONSTANT uint kMostBranches = 2;

/// Most steps of smoothing a fork's parts that fold.
VASA_CONSTANT uint kMostSmoothings = 20;

/// A ring of a vessel: its section at t of one span.
struct ForkRing {
  uint point;  // first of the span's four de Boor points
  uint knot;   // knot quaternion at the span's start
  uint spanClass;
  uint firstPoint, lastPoint;  // of its vessel
  float t;
  float turn;  // +1 where the vessel runs the fork's way (trunk: from a to b, branch: outwards), else -1
};

/// A branch that leaves a fork's trunk; constant over time.
struct ForkBranch {
  ForkRing ring;
  uint crossPoint, crossClass;  // its axis pierces the trunk's wall here: span and t
  float crossT;
  float centre;      // s of the hole's middle
  float holeAround;  // sine of the hole's half angle around the trunk
  float holeAlong;   // its half length, in s
  float cornerAround,
      cornerAlong;         // where wall and branch would meet without a fillet, as shares of the hole
  float window;            // share of the trunk's columns that the hole covers
  float holdCos, holdSin;  // of the half angle that has to stay within the window
  uint vessel;
};

/// A piece of trunk from ring a to ring b, with branches on its sides; constant over time.
struct ForkRecord {
  ForkRing a, b;
  float scaleA, scaleB;    // from d/dt of the rings' vessels to d/ds of the trunk, s in [0, 1]
  float row1, row2, row3;  // s of the trunk's inner rows; all holes lie between row1 and row3
  uint vesselA, vesselB;
  uint firstBranch, branchCount;
};

/// Most forks and threads of a workgroup; fewer where so many might not fit into a template.
VASA_CONSTANT uint kGroupForks = 64;
/// Most vertices of a fork, 8 bits number them, and quads that it is made of: as many as vertices, and what
/// lies between a hole and its window's four corners.
VASA_CONSTANT uint kMostForkVertices = (kTrunkRows + kMostBranches * (1 + kCollarRows)) * kMaxAround;
VASA_CONSTANT uint kMostForkPieces = kMostForkVertices + 4 * kMostBranches;

#ifndef __cplusplus
VASA_MEMORY(4) readonly buffer Forks { ForkRecord fork[]; };
VASA_MEMORY(4) readonly buffer Branches { ForkBranch branch[]; };
#endif

/// Of forks.comp: a thread a fork, a workgroup a group of them -> vertices, indices of the triangles that may
/// be seen, in the order of the forks, and an indirect draw a group (shared/filling.h).
struct ForksPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Forks) forks;
  VASA_ADDRESS(Branches) branches;
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(Uints) colours;          // of each fork, kind in the highest 8 bits
  VASA_ADDRESS(Uints) around;           // m of each vessel
  VASA_ADDRESS(Vertices) vertices;      // of a template
  VASA_ADDRESS(UintsOut) indices;       // the same memory: they lie among the vertices
  VASA_ADDRESS(UintsOut) blockColours;  // of each block of vertices: its fork's
  VASA_ADDRESS(Draws) draws;
  VASA_ADDRESS(Fill) filling;
  uint reserve;    // FillRoom's
  uint firstDraw;  // of the forks'
  uint keepAll;    // 1: every triangle is drawn
  uint unused;
};

#ifdef __cplusplus
static_assert(sizeof(ForkRing) == 28 && sizeof(ForkBranch) == 76 && sizeof(ForkRecord) == 92 &&
              sizeof(ForksPush) == 120);
}  // namespace vasa::shared
#endif
#endif
