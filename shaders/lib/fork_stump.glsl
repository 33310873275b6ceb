// Mirrors engine/surface/fork_stump.cpp: the same operations in the same order.
#ifndef VASA_FORK_STUMP
#define VASA_FORK_STUMP
#include "lib/fork_triangles.glsl"

const float kStumpWide = 0.8;   // share of the way to the tip
const float kStumpLeast = 0.5;  // depth in radii

/// `ring`, `wide`, `tip`: rows. `towards`: the tip, unless that lies less deep than half a radius.
void addStump(ForkShape shape, uint part, Ring ring, uint first, vec3 inward, vec3 towards, uint ringRow, uint wideRow, uint tipRow) {
  Section section = ring.section;
  precise vec3 way = towards - section.centre;
  float depth = dotOf(way, inward);
  precise vec3 tip = towards + max(kStumpLeast * section.radius - depth, 0.0) * inward;
  precise vec3 wide = section.centre + kStumpWide * (tip - section.centre);
  uint around = rowSize(shape, ringRow);
  // The ring, whose vertices stay where they are, the wide row and the tip, which may take its place.
  [[dont_unroll]] for (uint step = 0; step < 3; ++step) {
    uint row = step == 0 ? ringRow : step == 1 ? wideRow : tipRow, m = rowSize(shape, row), start = rowStart(shape, row);
    for (uint k = 0; k < m; ++k) {
      vec3 d = ringDirection(section, seamDirection(part, ring.turn, first, (k * around + m / 2) / m, around));
      precise vec3 onWide = wide + section.radius * d;
      put(start + k, SurfacePoint(step == 0 ? positionOf(start + k) : step == 1 ? onWide : tip, d));
    }
  }
}

#endif
