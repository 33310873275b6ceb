#pragma once

namespace vasa {

/// 1 at 0 and 0 from 1 on, twice continuously differentiable, flat at both: (1 - x⁴)³. Half of it is reached
/// at 0.67.
inline float bump(float x) {
  const float square = x * x, rest = 1 - square * square;
  return square < 1 ? rest * rest * rest : 0;
}

/// From 0 to 1 over [0, 1], with two derivatives 0 at both ends (Perlin 2002).
inline float smoothStep(float x) {
  const float t = x < 0 ? 0 : x > 1 ? 1 : x;
  return t * t * t * (t * (6 * t - 15) + 10);
}

}  // namespace vasa
