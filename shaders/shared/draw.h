// Read by C++ and GLSL (std430): push constants of everything that is drawn. All that the fragment
// stage needs is here, too: a uniform load costs far less than one through an address on a CPU device.
#ifndef VASA_SHARED_DRAW_H
#define VASA_SHARED_DRAW_H
#include "shared/language.h"
#ifdef __cplusplus
namespace vasa::shared {
#else
VASA_MEMORY(4) readonly buffer Colours { uint colour[]; };
#endif

VASA_CONSTANT uint kMeshKind = 8;
/// [pixels] from a capillary's edge outwards and inwards, over which it fades.
VASA_CONSTANT float kSoftEdge = 0.75;

/// Vertex v of a draw belongs to item v >> itemShift, which has one colour: sRGB, 8 bits each, red lowest;
/// the highest 8 bits are the item's kind (below 32): those of vessels, then kMeshKind + the role of a mesh.
struct DrawPush {
  mat4 viewProjection;
  vec4 turn;       // quaternion x y z w: from the world to the camera's axes
  vec4 cut;        // dot(cut, (pixel, depth, 1)) < 0: cut off; where draws are partial
  vec2 eyeCorner;  // towards the eye, in the camera's axes, at pixel p: (eyeCorner + p * (-eyeStep, eyeStep),
                   // 1)
  float eyeStep;
  uint shiftAndOpacities;  // itemShift; from bit 8 on, 8 bits each: opacity of arteries or meshes, of veins,
                           // of other vessels
  VASA_ADDRESS(Colours) colours;
  float opacity;     // of the skin and of capillaries; in x-ray the light that a surface gathers
  uint hiddenKinds;  // bit k: items of kind k are not drawn
};

#ifdef __cplusplus
static_assert(sizeof(DrawPush) == 128 && offsetof(DrawPush, colours) == 112);
}  // namespace vasa::shared
#endif
#endif
