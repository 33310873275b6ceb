// Read by C++ and GLSL (scalar layout): push constants of everything that is drawn. All that the fragment
// stage needs is here, too: a uniform load costs far less than one through an address on a CPU device.
#ifndef VASA_SHARED_DRAW_H
#define VASA_SHARED_DRAW_H
#ifdef __cplusplus
#include <cstddef>
#include <cstdint>

#include "math/types.h"
namespace vasa::shared {
using uint = std::uint32_t;
#define VASA_ADDRESS(Block) std::uint64_t
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Colours { uint colour[]; };
#define VASA_ADDRESS(Block) Block
#endif

/// Vertex v of a draw belongs to item firstItem + (v >> itemShift), which has one colour: sRGB, 8 bits each,
/// red lowest; the highest 8 bits are the item's kind (below 32).
struct DrawPush {
  mat4 viewProjection;
  vec3 right, up;  // the camera's axes in the world, unit
  vec2 eyeCorner, eyeStep;  // towards the eye, in the camera's axes, at pixel p: (eyeCorner + p * eyeStep, 1)
  VASA_ADDRESS(Colours) colours;
  uint firstItem;
  uint itemShift;
  float opacity;
  uint hiddenKinds;  // bit k: items of kind k are not drawn
};

#ifdef __cplusplus
static_assert(sizeof(DrawPush) == 128 && offsetof(DrawPush, colours) == 104);
}  // namespace vasa::shared
#endif
#undef VASA_ADDRESS
#endif
