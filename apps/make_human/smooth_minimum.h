#pragma once
#include <algorithm>
#include <cmath>

namespace vasa::human {

/// Quadratic smooth minimum (Quilez): unites two distances within a radius k; k 0 is the plain minimum.
inline float smoothMinimum(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f);
  return k > 0 ? std::min(a, b) - h * h / (4 * k) : std::min(a, b);
}

}  // namespace vasa::human
