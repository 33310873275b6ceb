// Read by C++ and GLSL (std430): walls of the source mesh kept around forks. Five passes:
//   patches    a thread a seam   -> how the vertices that follow its ring move, the ring's vertices, and the
//   triangles of the
//                                   strip between ring and patch
//   skin       a thread a vertex -> the patch's vertices (shared/skin.h)
//   patch_strain     a thread some patches -> those that their rings strain, and a dispatch of
//   patch_smooth     a workgroup a strained patch -> its vertices, smoothed where they are pressed together
//   patch_triangles  a thread some triangles, a workgroup a group of them -> indices of those that may be
//   seen, in their
//                                   order, and an indirect draw a group
#ifndef VASA_SHARED_PATCH_H
#define VASA_SHARED_PATCH_H
#include "shared/fork.h"
#include "shared/skin.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Threads of a workgroup that looks at triangles, and triangles of a thread.
VASA_CONSTANT uint kPatchThreads = 128, kThreadTriangles = 8;

/// Threads that look for strained patches, and of a workgroup that smooths one.
VASA_CONSTANT uint kStrainThreads = 64, kSmoothThreads = 64;
/// Steps of smoothing a strained patch; odd, as they go to and fro between two buffers.
VASA_CONSTANT uint kPatchSteps = 7;
/// Larger patches are not smoothed, nor are vertices with more triangles: devices bound the loops.
VASA_CONSTANT uint kMostSmoothed = 4096, kMostFan = 32;

/// Where a patch meets a tube; constant over time. What is said to be at rest is so when the patch was cut
/// out.
struct PatchSeam {
  ForkRing ring;   // turn: +1 where the vessel runs away from the fork
  uint firstSeam;  // of the patch: its frame follows from the centres of that one and the two behind it
  vec3 centre;     // of the ring, at rest
  float radius;
  vec3 outward;
  uint loop;       // the loop's first vertex
  vec3 across;     // two axes of the patch's frame, at rest
  uint loopCount;  // vertices of the loop
  vec3 beside;
  uint vertex;  // where the ring's vertices (kMaxAround) begin
  vec3 start;   // the loop's first vertex from the centre, at rest
  uint index;   // where the strip's indices begin
  uint vessel;
  uint unused0, unused1, unused2;
};

/// A patch's seams and vertices.
struct PatchWall {
  uint firstSeam, seamCount;
  uint firstVertex, vertexCount;
};

/// A triangle at a vertex of a patch that no loop holds.
struct FanTriangle {
  uint corners;   // the two others, counted from the patch's first vertex, in 16 bits each
  float perArea;  // one by twice its area at rest [1/m2]
};

/// A patch to be smoothed, and how much, in (0, 1].
struct StrainedPatch {
  uint wall;
  float share;
};

#ifndef __cplusplus
VASA_MEMORY(4) readonly buffer Seams { PatchSeam seam[]; };
VASA_MEMORY(4) readonly buffer Shares { float share[]; };
VASA_MEMORY(8) writeonly buffer JointsOut { Word2 row[]; };
VASA_MEMORY(8) readonly buffer VerticesIn { Word2 vertex[]; };
VASA_MEMORY(4) readonly buffer PatchWalls { PatchWall wall[]; };
VASA_MEMORY(8) readonly buffer PatchJoints { Word2 row[]; };
VASA_MEMORY(8) readonly buffer Fans { Word triangle[]; };
VASA_MEMORY(4) readonly buffer Strained { StrainedPatch patches[]; };
VASA_MEMORY(4) writeonly buffer StrainedOut { StrainedPatch patches[]; };
VASA_MEMORY(4) writeonly buffer DispatchOut { uint x, y, z; };
VASA_MEMORY(8) coherent buffer SmoothedVertices { Word2 vertex[]; };
#endif

struct PatchesPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(Seams) seams;
  VASA_ADDRESS(Shares) shares;     // of each vertex of a loop: how far around it lies, in [0, 1)
  VASA_ADDRESS(Uints) around;      // m of each vessel
  VASA_ADDRESS(JointsOut) joints;  // one a seam
  VASA_ADDRESS(Vertices) vertices;
  VASA_ADDRESS(UintsOut) indices;
  uint count;
  uint unused;
};

struct PatchStrainPush {
  VASA_ADDRESS(Seams) seams;
  VASA_ADDRESS(PatchWalls) walls;
  VASA_ADDRESS(PatchJoints) joints;
  VASA_ADDRESS(StrainedOut) strained;  // room for all patches
  VASA_ADDRESS(DispatchOut) dispatch;  // a workgroup a strained patch
  uint count;                          // of patches
  uint unused;
};

struct PatchSmoothPush {
  VASA_ADDRESS(PatchWalls) walls;
  VASA_ADDRESS(Strained) strained;
  VASA_ADDRESS(Uints) firstFan;  // of each vertex, and the end
  VASA_ADDRESS(Fans) fans;
  VASA_ADDRESS(SmoothedVertices) vertices;
  VASA_ADDRESS(SmoothedVertices) between;  // as many
};

struct PatchTrianglesPush {
  VASA_ADDRESS(VerticesIn) vertices;
  VASA_ADDRESS(Uints) all;  // indices of all triangles
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(UintsOut) indices;
  VASA_ADDRESS(Draws) draws;
  uint count;    // of all triangles
  uint keepAll;  // 1: every triangle is drawn
};

#ifdef __cplusplus
static_assert(sizeof(PatchSeam) == 128 && sizeof(PatchesPush) == 80 && sizeof(PatchTrianglesPush) == 48);
static_assert(sizeof(PatchWall) == 16 && sizeof(FanTriangle) == 8 && sizeof(StrainedPatch) == 8);
static_assert(sizeof(PatchStrainPush) == 48 && sizeof(PatchSmoothPush) == 48 && kPatchSteps % 2 == 1);
}  // namespace vasa::shared
#endif
#endif
