#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/aabb.h"

// Solids united of pieces that have `bounds`, `blend`, `carve`, `cell` and a signed `distance(p)`.
namespace vasa::human {

/// Quadratic smooth minimum (Quilez): unites two distances within a radius k; k 0 is the plain minimum.
inline float smoothMinimum(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f);
  return k > 0 ? std::min(a, b) - h * h / (4 * k) : std::min(a, b);
}

inline float boxDistance(const Aabb& box, vec3 p) {
  return glm::length(glm::max(glm::max(box.low - p, p - box.high), vec3(0)));
}

/// [m] negative inside. Pieces are added, or carved out of those before them; those too far to matter are not
/// looked at.
/// @param deep  what is carved counts deep inside the solid, too, not only near its surface
template <class Piece>
float unionDistance(const std::vector<Piece>& pieces, vec3 p, bool deep) {
  float result = 1;
  for (const Piece& piece : pieces) {
    const float beyond = boxDistance(piece.bounds, p);
    if (piece.carve) {
      if (beyond <= piece.blend + (deep ? std::max(-result, 0.0f) : 0.0f))
        result = -smoothMinimum(-result, piece.distance(p), piece.blend);
    } else if (beyond < result + piece.blend) {
      result = smoothMinimum(result, piece.distance(p), piece.blend);
    }
  }
  return result;
}

/// The gradient of a distance, by differences over h to both sides [m].
template <class Solid>
vec3 slopeOf(const Solid& solid, vec3 p, float h = 2e-4f) {
  vec3 slope;
  for (int i = 0; i < 3; ++i) {
    vec3 low = p, high = p;
    low[i] -= h;
    high[i] += h;
    slope[i] = (solid.distance(high) - solid.distance(low)) / (2 * h);
  }
  return slope;
}

/// [m] Wanted size of the polygons within `reach` of a point: of the pieces whose surface passes there, the
/// least.
template <class Piece>
float unionCellSize(const std::vector<Piece>& pieces, vec3 p, float reach) {
  float size = 1;
  for (const Piece& piece : pieces)
    if (piece.cell < size && boxDistance(piece.bounds, p) < reach &&
        std::abs(piece.distance(p)) < 0.8f * reach + 0.5f * piece.cell)
      size = piece.cell;
  return size;
}

template <class Piece>
Aabb unionBounds(const std::vector<Piece>& pieces) {
  Aabb box;
  for (const Piece& piece : pieces)
    if (!piece.carve) box.add(piece.bounds);
  return box;
}

}  // namespace vasa::human
