// Read by C++ and GLSL (scalar layout): push constants of the compute passes that write vertices.
#ifndef VASA_SHARED_TESSELLATE_H
#define VASA_SHARED_TESSELLATE_H
#include "shared/sweep.h"
#ifdef __cplusplus
namespace vasa::shared {
#define VASA_ADDRESS(Block) std::uint64_t
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Points { vec4 point[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Knots { vec4 knot[]; };  // x y z w
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Sweeps { SweepRecord sweep[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Caps { uint cap[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Vertices { TubeVertex vertex[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Tables {
  mat4 spanClass[kSpanClasses];  // de Boor to Bézier points
  vec2 direction[kMaxAround];    // (cos θ, sin θ) of the template's m directions
  vec2 polar[kCapRings + 1];     // (cos φ, sin φ) from a cap's rim to its pole
};
#define VASA_ADDRESS(Block) Block
#endif

/// Of tessellate.comp and cap.comp: items [first, first + count) into a template that starts at vertices.
struct TessellatePush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Sweeps) sweeps;
  VASA_ADDRESS(Caps) caps;  // sweep * 2 + (last ? 1 : 0)
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(Vertices) vertices;
  uint first;
  uint count;
  uint around;
  uint along;
};

#ifdef __cplusplus
/// What `tables` points at.
struct TessellateTables {
  mat4 spanClass[kSpanClasses];
  vec2 direction[kMaxAround];
  vec2 polar[kCapRings + 1];
};
static_assert(sizeof(TessellatePush) == 64 && sizeof(TessellateTables) == 64 * 9 + 8 * 16 + 8 * 4);
}  // namespace vasa::shared
#endif
#undef VASA_ADDRESS
#endif
