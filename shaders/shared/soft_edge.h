// Read by C++ and GLSL.
#ifndef VASA_SHARED_SOFT_EDGE_H
#define VASA_SHARED_SOFT_EDGE_H
#ifdef __cplusplus
namespace vasa::shared {
#define VASA_CONSTANT constexpr
#else
#define VASA_CONSTANT const
#endif

/// [pixels] from a capillary's edge outwards and inwards, over which it fades.
VASA_CONSTANT float kSoftEdge = 0.75;

#ifdef __cplusplus
}  // namespace vasa::shared
#endif
#undef VASA_CONSTANT
#endif
