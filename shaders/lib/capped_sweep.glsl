// A sweep with its caps as rings, one behind the other: a first cap's pole and rings, the sweep's own, a last cap's.
#ifndef VASA_CAPPED_SWEEP
#define VASA_CAPPED_SWEEP
#include "lib/records.glsl"

struct Item {
  uint sweep, along, around, rings, before;  // before: rings of a first cap
  uint capRings;                             // of each cap, the rim included
};

vec2 polars[kCapRings + 1];
vec2 directions[kMaxAround];

// @param fixedQuads  m is not the picture's choice (capRings() of tests/reference/detail.h)
Item itemOf(SweepRecord record, uint sweep, uint along, uint around, bool fixedQuads) {
  uint capRings = !fixedQuads && around < kRoundAround ? 1 : kCapRings, before = capRings * (record.caps & 1u);
  return Item(sweep, along, around, before + along + 1 + capRings * (record.caps >> 1), before, capRings);
}

// A ring's place on the sweep and, of a cap's, from rim to pole.
uint innerRing(Item it, uint ring) { return clamp(ring, it.before, it.before + it.along) - it.before; }
vec2 polarOf(Item it, uint ring) {
  uint fromRim = ring < it.before ? it.before - ring : ring - it.before - innerRing(it, ring);
  return polars[it.capRings == 1 ? kCapRings * fromRim : fromRim];
}
float outwardOf(Item it, uint ring) { return ring < it.before ? -1.0 : 1.0; }

// Fills in polars, and directions, turned step by step as ringDirections() does.
void prepare(Item it, Tables tables) {
  for (uint i = 0; i <= kCapRings; ++i) polars[i] = i == 0 ? vec2(1, 0) : polarAt(tables, i);
  vec2 step = stepAt(tables, it.around);
  precise vec2 direction = vec2(1, 0);
  uint k = 0;
  do {
    directions[k] = direction;
    direction = vec2(direction.x * step.x - direction.y * step.y, direction.x * step.y + direction.y * step.x);
  } while (++k < it.around);
}

#endif
