// Read by C++ and GLSL (std430): how a network's tubes become triangles. The passes, one dispatch each:
//   measure    a thread a sweep of the network -> n of each sweep, radius of each vessel in pixels
//   around     a thread a vessel               -> m of each vessel
//   tubes      a thread a sweep, a workgroup a group of them -> vertices, indices of the triangles that may
//   be seen, in
//              the order of the sweeps, and an indirect draw a group (shared/filling.h)
#ifndef VASA_SHARED_TUBES_H
#define VASA_SHARED_TUBES_H
#include "shared/filling.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Most sweeps and threads of a workgroup; fewer where so many might not fit into a template.
VASA_CONSTANT uint kGroupSweeps = 128;
/// Fewest sweeps or forks of a workgroup.
VASA_CONSTANT uint kLeastGroup = 16;
/// Vertices of one item (a sweep, a fork) lie in whole blocks, the items' blocks of a group one behind the
/// other: what is drawn stays close together in memory, and a vertex finds its item's colour.
VASA_CONSTANT uint kBlockShift = 3, kBlockVertices = 1 << kBlockShift;
/// Most strips between the rings of a sweep, its caps included.
VASA_CONSTANT uint kMaxStrips = kMaxAlong + 2 * kCapRings;
/// Place of a vertex that has none on the picture.
VASA_CONSTANT float kBehind = 3e30;

/// What of the network's tessellation never changes.
struct TubeTables {
  mat4 spanClass[kSpanClasses];       // de Boor to Bézier points
  vec2 step[kMaxAround + 1];          // (cos, sin) of 2π/m
  vec2 halfStep[kMaxAround + 1];      // (cos, sin) of π/m
  vec2 polar[kCapRings + 1];          // (cos φ, sin φ) from a cap's rim to its pole
  float aroundError[kMaxAround + 1];  // 1 - cos(π/m)
};

/// VkDrawIndexedIndirectCommand.
struct DrawCommand {
  uint indexCount, instanceCount, firstIndex;
  int vertexOffset;
  uint firstInstance;
};

#ifndef __cplusplus
#include "lib/words.glsl"
// In words: vec4 and TubeVertex (lib/words.glsl); SweepRecord, TubeTables and DetailView (lib/records.glsl).
VASA_MEMORY(8) readonly buffer Points { Word2 point[]; };
VASA_MEMORY(8) readonly buffer Knots { Word2 knot[]; };  // x y z w
VASA_MEMORY(8) readonly buffer Sweeps { Word word[]; };
VASA_MEMORY(8) readonly buffer Tables { Word word[]; };
VASA_MEMORY(8) readonly buffer View { Word word[]; };
VASA_MEMORY(4) readonly buffer Uints { uint value[]; };
VASA_MEMORY(4) writeonly buffer UintsOut { uint value[]; };
VASA_MEMORY(4) buffer Sizes { uint size[]; };
VASA_MEMORY(8) writeonly buffer Vertices { Word2 vertex[]; };
VASA_MEMORY(4) writeonly buffer Draws { DrawCommand draw[]; };
VASA_MEMORY(4) buffer RoundDraws { DrawCommand draw[]; };
#endif

struct MeasurePush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Sweeps) sweeps;
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(Uints) colours;   // kind in the highest 8 bits
  VASA_ADDRESS(UintsOut) along;  // n of each sweep, 0: not drawn
  VASA_ADDRESS(Sizes) sizes;     // of each vessel: bits of the radius in pixels, 0 before and after a frame
  uint count;
  uint unused;
};

struct AroundPush {
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(Sizes) sizes;
  VASA_ADDRESS(UintsOut) around;  // m of each vessel
  uint count;
  uint unused;
};

/// A sweep's rings, caps included, run along the vessel: a first cap's pole and rings, the rings of t = 0 ..
/// 1, a last cap's rings and pole. A pole is a ring whose vertices coincide.
struct TubesPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Sweeps) sweeps;
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(View) view;
  VASA_ADDRESS(Uints) along;            // n of each sweep, 0: not drawn
  VASA_ADDRESS(Uints) around;           // m of each vessel
  VASA_ADDRESS(Uints) colours;          // of each sweep
  VASA_ADDRESS(Vertices) vertices;      // of a template
  VASA_ADDRESS(UintsOut) indices;       // the same memory: they lie among the vertices
  VASA_ADDRESS(UintsOut) blockColours;  // of each block of vertices: its sweep's
  VASA_ADDRESS(Draws) draws;
  VASA_ADDRESS(Fill) filling;
  uint reserve;  // FillRoom's
  uint keepAll;  // 1: every triangle is drawn
};

/// Of template_plan.comp. Draws: the window's groups of tubes, then those of forks.
struct PlanPush {
  VASA_ADDRESS(Fill) filling;
  VASA_ADDRESS(RoundDraws) draws;
  uint groupSweeps, groupForks;
  FillRoom room;
};

#ifdef __cplusplus
static_assert(sizeof(PlanPush) == 40);
static_assert(offsetof(TubeTables, polar) == 8 * (8 * kSpanClasses + 2 * (kMaxAround + 1)));
static_assert(sizeof(TubeTables) == 64 * 9 + 20 * 17 + 8 * 4 && sizeof(DrawCommand) == 20);
static_assert(sizeof(MeasurePush) == 64 && sizeof(AroundPush) == 40 && sizeof(TubesPush) == 112);
}  // namespace vasa::shared
#endif
#endif
