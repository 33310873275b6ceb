// Read by C++ and GLSL (scalar layout): walls of the source mesh kept around forks. Three passes:
//   patches    a thread a seam   -> how the vertices that follow its ring move, the ring's vertices, and the triangles of the
//                                   strip between ring and patch
//   skin       a thread a vertex -> the patch's vertices (shared/skin.h)
//   patch_triangles  a thread some triangles, a workgroup a group of them -> indices of those that may be seen, in their
//                                   order, and an indirect draw a group
#ifndef VASA_SHARED_PATCH_H
#define VASA_SHARED_PATCH_H
#include "shared/fork.h"
#include "shared/skin.h"
#ifdef __cplusplus
namespace vasa::shared {
#define VASA_ADDRESS(Block) std::uint64_t
#define VASA_CONSTANT constexpr
#else
#define VASA_ADDRESS(Block) Block
#define VASA_CONSTANT const
#endif

/// Threads of a workgroup that looks at triangles, and triangles of a thread.
VASA_CONSTANT uint kPatchThreads = 128, kThreadTriangles = 8;

/// Where a patch meets a tube; constant over time. What is said to be at rest is so when the patch was cut out.
struct PatchSeam {
  ForkRing ring;              // turn: +1 where the vessel runs away from the fork
  vec3 centre, outward;       // of the ring, at rest
  float radius;
  vec3 across, beside;        // two axes of the patch's frame, at rest
  vec3 start;                 // the loop's first vertex from the centre, at rest
  uint firstSeam;             // of the patch: its frame follows from the centres of that one and the two behind it
  uint loop, loopCount;       // the loop's first vertex, and how many
  uint vertex, index;         // where the ring's vertices (kMaxAround) and the strip's indices begin
  uint vessel;
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Seams { PatchSeam seam[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Shares { float share[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer JointsOut { u64vec2 row[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer VerticesIn { u64vec2 vertex[]; };
#endif

struct PatchesPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(Seams) seams;
  VASA_ADDRESS(Shares) shares;      // of each vertex of a loop: how far around it lies, in [0, 1)
  VASA_ADDRESS(Uints) around;       // m of each vessel
  VASA_ADDRESS(JointsOut) joints;   // one a seam
  VASA_ADDRESS(Vertices) vertices;
  VASA_ADDRESS(UintsOut) indices;
  uint count;
  uint unused;
};

struct PatchTrianglesPush {
  VASA_ADDRESS(VerticesIn) vertices;
  VASA_ADDRESS(Uints) all;          // indices of all triangles
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(UintsOut) indices;
  VASA_ADDRESS(Draws) draws;
  uint count;                       // of all triangles
  uint keepAll;                     // 1: every triangle is drawn
};

#ifdef __cplusplus
static_assert(sizeof(PatchSeam) == 116 && sizeof(PatchesPush) == 80 && sizeof(PatchTrianglesPush) == 48);
}  // namespace vasa::shared
#endif
#undef VASA_ADDRESS
#undef VASA_CONSTANT
#endif
