// Mirrors engine/surface/fork_stump.cpp: the same operations in the same order. The shader that
// includes it has
//   void put(uint vertex, SurfacePoint point)   takes a vertex
#ifndef VASA_FORK_STUMP
#define VASA_FORK_STUMP
#include "lib/fork_triangles.glsl"

const float kStumpWide = 0.8;   // share of the way to the tip
const float kStumpLeast = 0.5;  // depth in radii

/// `ring`, `wide`, `tip`: rows. `towards`: the tip, unless that lies less deep than half a radius.
void addStump(ForkShape shape, Ring ring, uint first, vec3 inward, vec3 towards, uint ringRow, uint wideRow, uint tipRow) {
  Section section = ring.section;
  precise vec3 way = towards - section.centre;
  float depth = dotOf(way, inward);
  precise vec3 tip = towards + max(kStumpLeast * section.radius - depth, 0.0) * inward;
  precise vec3 wide = section.centre + kStumpWide * (tip - section.centre);
  uint around = rowSize(shape, ringRow), count = rowSize(shape, tipRow);
  setDirections(stepOf(around), around);
  for (uint k = 0; k < around; ++k) {
    vec3 d = ringDirection(section, seamDirection(ring, first, k, around));
    uint vertex = rowStart(shape, ringRow) + k;
    put(vertex, SurfacePoint(corners[vertex].position, d));
    precise vec3 position = wide + section.radius * d;
    if (wideRow != tipRow) put(rowStart(shape, wideRow) + k, SurfacePoint(position, d));
  }
  for (uint k = 0; k < count; ++k)
    put(rowStart(shape, tipRow) + k,
        SurfacePoint(tip, ringDirection(section, seamDirection(ring, first, (k * around + count / 2) / count, around))));
}

#endif
