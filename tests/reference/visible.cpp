#include "reference/visible.h"

#include <array>
#include <cmath>
#include <span>

#include "shared/tubes.h"

// However its corners move by s at most in each coordinate, a triangle stays within itself widened by a
// square of 2 s, and so behind its own edges moved outwards by s (|x| + |y|) of the edge, in units of twice
// an area. Its own area moves by less than 4 s (width + height), of that wider box.
namespace vasa {
namespace {

// Of the samples in their pixels, from the middle.
constexpr std::array<vec2, 1> kMiddle{vec2(0)};
constexpr std::array<vec2, 4> kStandardPlaces{vec2(-0.125f, -0.375f), vec2(0.375f, -0.125f),
                                              vec2(-0.375f, 0.125f), vec2(0.125f, 0.375f)};

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// An edge from p, and how far the area that it spans with a sample may move as its ends do.
struct Edge {
  Edge(vec2 from, vec2 to, float snap)
      : p(from), along(to - from), moved(snap * (std::abs(along.x) + std::abs(along.y))) {}
  vec2 p, along;
  float moved;
};

// Twice the areas that an edge spans with four samples: above 0 before the edge of a front, as y points down.
vec4 areasWith(const Edge& edge, vec2 first, vec2 span) {
  const float at = cross2(edge.along, first - edge.p);
  const float alongX = -edge.along.y * span.x, alongY = edge.along.x * span.y;
  return {at, at + alongX, at + alongY, at + alongX + alongY};
}

// Whether any of four samples lies behind three edges, or hardly before them.
bool anyWithin(vec4 p, vec4 q, vec4 r, vec3 moved) {
  for (int k = 0; k < 4; ++k)
    if (p[k] <= moved.x && q[k] <= moved.y && r[k] <= moved.z) return true;
  return false;
}

}  // namespace

std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, const PictureGrid& grid) {
  const vec2 low = glm::min(glm::min(a, d), glm::min(b, c)) - grid.snap,
             high = glm::max(glm::max(a, d), glm::max(b, c)) + grid.snap, reach = high - low;
  if (high.x >= 0.5f * shared::kBehind) return 3;
  const float backs = 4 * grid.snap * (reach.x + reach.y);
  const Edge ab(a, b, grid.snap), bc(b, c, grid.snap), ac(a, c, grid.snap), cd(c, d, grid.snap),
      da(d, a, grid.snap);
  bool abc = false, acd = false;
  for (const vec2 place : grid.samples == 1 ? std::span<const vec2>(kMiddle) : kStandardPlaces) {
    const vec2 first = glm::max(glm::ceil(low - place), vec2(0)), from = first + place;
    const vec2 span = glm::min(glm::floor(high - place), grid.size - 1.0f) - first;
    if (span.x < 0 || span.y < 0) continue;
    const bool large = span.x > 1 || span.y > 1;  // else each of its samples is looked at
    const vec4 diagonal = areasWith(ac, from, span);
    abc = abc || large ||
          anyWithin(areasWith(ab, from, span), areasWith(bc, from, span), -diagonal,
                    {ab.moved, bc.moved, ac.moved});
    acd = acd || large ||
          anyWithin(areasWith(cd, from, span), areasWith(da, from, span), diagonal,
                    {cd.moved, da.moved, ac.moved});
  }
  const bool front = cross2(ab.along, bc.along) <= backs, frontToo = cross2(ac.along, cd.along) <= backs;
  return (abc && front ? 1u : 0u) | (acd && frontToo ? 2u : 0u);
}

}  // namespace vasa
