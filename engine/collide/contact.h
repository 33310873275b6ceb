#pragma once
#include <compare>
#include <cstdint>

#include "math/types.h"

// What detection speaks about. A tube is one Bézier segment with a radius: the union of the balls of radius
// r(t) around C(t). For two tubes A and B
//   f(A, B) = min over s, t of |A(s) - B(t)| - r_A(s) - r_B(t),
// and they intersect where f < 0.
namespace vasa {

/// Two tubes by their numbers, i < j.
struct TubePair {
  std::uint32_t i = 0, j = 0;
  auto operator<=>(const TubePair&) const = default;
};

inline TubePair orderedPair(std::uint32_t a, std::uint32_t b) {
  return a < b ? TubePair{a, b} : TubePair{b, a};
}

/// Where two tubes come nearest, for whoever has to part them.
struct Contact {
  std::uint32_t i = 0, j = 0;  ///< i < j
  float s = 0, t = 0;          ///< parameters on tubes i and j
  float f = 0;                 ///< [m] distance between the two balls' surfaces; negative: depth
  vec3 normal{0, 0, 1};        ///< unit, from C_j(t) to C_i(s); some perpendicular where the two coincide
};

/// What overlaps at rest may be deeper by so much before it counts [m]: network files round coordinates and
/// radii by up to 15 µm, so that is how well the depth at rest is known.
constexpr float kRestTolerance = 2e-5f;

}  // namespace vasa
