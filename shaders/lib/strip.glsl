// The strip of quads between two rings of a sweep, in bits: 2k for triangle (a, b, c) and 2k + 1 for (a, c, d) of the quad
// behind direction k, or 2k for vertex k of a ring.
#ifndef VASA_STRIP
#define VASA_STRIP

const uint kEvenBits = 0x55555555u;

// The vertices of a ring that are there, packed.
struct RingVertices {
  uint vertex;  // the first one
  uint bits;
};

uint wholeStrip(uint around) { return 0xffffffffu >> (32 - 2 * around); }

// Each vertex' next one around.
uint nextAround(uint bits, uint around) { return (bits << 2 | bits >> (2 * around - 2)) & wholeStrip(around); }

// Vertices of either ring that a strip's triangles need.
uint firstRingOf(uint mask, uint around) {
  uint abc = mask & kEvenBits, acd = mask >> 1 & kEvenBits;
  return abc | acd | nextAround(abc, around);
}

uint secondRingOf(uint mask, uint around) {
  uint abc = mask & kEvenBits, acd = mask >> 1 & kEvenBits;
  return acd | nextAround(abc | acd, around);
}

uint vertexAt(RingVertices ring, uint k) { return ring.vertex + uint(bitCount(ring.bits & ((1u << 2 * k) - 1u))); }

// Corners of the triangle of one bit.
uvec3 stripTriangle(uint bit, RingVertices first, RingVertices second, uint around) {
  uint k = bit >> 1, next = k + 1 == around ? 0 : k + 1;
  bool abc = (bit & 1u) == 0u;
  uint c = vertexAt(second, next);
  return uvec3(vertexAt(first, k), abc ? vertexAt(first, next) : c, abc ? c : vertexAt(second, k));
}

#endif
