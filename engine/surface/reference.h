#pragma once
#include <span>

#include "math/direction.h"
#include "surface/sweep_table.h"
#include "surface/tessellate.h"

// What the CPU references of the shaders have in common: the shaders' own arithmetic, term by term and in
// their order, so that both come to the same bits.
namespace vasa {

inline float dotOf(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The span that begins at a de Boor point, from its class's matrix.
inline Bezier bezierAt(const PosedNetwork& network, std::uint32_t point, std::uint32_t spanClass) {
  const mat4& m = spanClassMatrices()[spanClass];
  const vec4* d = &network.points[point];
  const auto row = [&](int i) { return m[0][i] * d[0] + m[1][i] * d[1] + m[2][i] * d[2] + m[3][i] * d[3]; };
  return {{row(0), row(1), row(2), row(3)}};
}

/// The one of some directions nearest to another; the first of several.
inline std::uint32_t nearestOf(std::span<const vec2> directions, vec2 wanted) {
  std::uint32_t first = 0;
  float best = -3e38f;
  for (std::uint32_t k = 0; k < directions.size(); ++k) {
    const float along = wanted.x * directions[k].x + wanted.y * directions[k].y;
    if (along > best) best = along, first = k;
  }
  return first;
}

}  // namespace vasa
