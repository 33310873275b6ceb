#pragma once
#include "math/types.h"

namespace vasa {

/// All points within `radius` of the segment ab: a line-swept sphere (LSS).
struct Capsule {
  vec3 a, b;
  float radius = 0;
};

struct Sphere {
  vec3 centre;
  float radius = 0;
};
static_assert(sizeof(Sphere) == 16);

}  // namespace vasa
