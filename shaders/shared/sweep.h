// Read by C++ and GLSL (std430): how a network's sweeps lie in memory for tessellation.
#ifndef VASA_SHARED_SWEEP_H
#define VASA_SHARED_SWEEP_H
#include "shared/language.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Fewest and most quads around (m) and along (n) a sweep.
VASA_CONSTANT uint kMinAround = 3, kMaxAround = 16, kMinAlong = 2, kMaxAlong = 20;
/// Spans differ by how near they are to a vessel's two ends: min(2, distance) each way.
VASA_CONSTANT uint kSpanClasses = 9;
/// SweepRecord::nextClass of a vessel's last span.
VASA_CONSTANT uint kNoSpan = 0xffffffffu;
/// Rings of a cap between its rim and its pole, the rim included.
VASA_CONSTANT uint kCapRings = 3;

/// One span of a vessel, or a part of one; constant over time.
struct SweepRecord {
  uint point;                  // first of its four de Boor points
  uint knot;                   // knot quaternion at its start; the next one is at its end
  uint spanClass;              // matrix from de Boor to Bézier points
  uint nextClass;              // of the span behind it, or kNoSpan
  uint firstPoint, lastPoint;  // of its vessel
  uint vessel;
  uint caps;       // bit 0: its first ring is closed by a cap, bit 1: its last one
  float from, to;  // part of the span that is drawn as a tube, in [0, 1]; forks take the rest
};

/// A tessellated vertex: 16 bytes.
struct TubeVertex {
  float x, y, z;  // [m]
  uint normal;    // octahedral, two signed 16-bit numbers
};

#ifdef __cplusplus
static_assert(sizeof(SweepRecord) == 40 && sizeof(TubeVertex) == 16);
}  // namespace vasa::shared
#endif
#endif
