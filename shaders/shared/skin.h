// Read by C++ and GLSL (std430): linear blend skinning.
#ifndef VASA_SHARED_SKIN_H
#define VASA_SHARED_SKIN_H
#include "shared/sweep.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// A vertex at rest and the joints that move it: 40 bytes.
struct SkinVertex {
  float x, y, z;  // [m]
  uint normal;    // octahedral
  uint joints01;  // two 16-bit joints, the first in the low half
  uint joints23;
  vec4 weights;  // sum 1
};

/// The first three rows of a joint's matrix; the fourth is 0 0 0 1.
struct JointRows {
  vec4 row0, row1, row2;
};

#ifndef __cplusplus
#include "lib/words.glsl"
// In words (lib/words.glsl): SkinVertex, JointRows and TubeVertex.
VASA_MEMORY(8) readonly buffer SkinVertices { Word word[]; };
VASA_MEMORY(8) readonly buffer Joints { Word2 row[]; };
VASA_MEMORY(8) writeonly buffer PosedVertices { Word2 vertex[]; };
#endif

struct SkinPush {
  VASA_ADDRESS(SkinVertices) rest;
  VASA_ADDRESS(Joints) joints;
  VASA_ADDRESS(PosedVertices) posed;
  uint count;
  uint jointCount;
  vec3 centre;  // that all are drawn together to, at rest
  float scale;
};

#ifdef __cplusplus
static_assert(sizeof(SkinVertex) == 40 && sizeof(JointRows) == 48 && sizeof(SkinPush) == 48);
}  // namespace vasa::shared
#endif
#endif
