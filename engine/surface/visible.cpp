#include "surface/visible.h"

#include <algorithm>
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
  vec2 p, along;
  float moved;
};

Edge edgeOf(vec2 p, vec2 q, float snap) {
  return {p, q - p, snap * (std::abs(q.x - p.x) + std::abs(q.y - p.y))};
}

// Twice the areas of the edge with four samples: above 0 well beyond the edge of a front, as y points down.
vec4 wellBeyond(const Edge& edge, vec2 first, vec2 span) {
  const float at = cross2(edge.along, first - edge.p) - edge.moved;
  const float alongX = -edge.along.y * span.x, alongY = edge.along.x * span.y;
  return {at, at + alongX, at + alongY, at + alongX + alongY};
}

// @param low, high  of the box that holds the triangle, however its corners move
bool mayCover(const std::array<Edge, 3>& edges, vec2 low, vec2 high, vec2 size, vec2 place) {
  const vec2 first = glm::max(glm::ceil(low - place), vec2(0)),
             last = glm::min(glm::floor(high - place), size - 1.0f);
  const vec2 span = last - first, from = first + place;
  if (span.x < 0 || span.y < 0) return false;
  if (span.x > 1 || span.y > 1) return true;
  // small: each of its samples is looked at
  const vec4 outside = glm::max(glm::max(wellBeyond(edges[0], from, span), wellBeyond(edges[1], from, span)),
                                wellBeyond(edges[2], from, span));
  return std::min(std::min(outside.x, outside.y), std::min(outside.z, outside.w)) <= 0;
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, const PictureGrid& grid) {
  const vec2 low = glm::min(glm::min(a, b), c) - grid.snap, high = glm::max(glm::max(a, b), c) + grid.snap;
  if (high.x >= 0.5f * shared::kBehind) return true;
  const std::array<Edge, 3> edges{edgeOf(a, b, grid.snap), edgeOf(b, c, grid.snap), edgeOf(c, a, grid.snap)};
  const vec2 reach = high - low;
  if (cross2(edges[0].along, edges[1].along) > 4 * grid.snap * (reach.x + reach.y)) return false;
  const std::span<const vec2> places = grid.samples == 1 ? std::span<const vec2>(kMiddle) : kStandardPlaces;
  return std::ranges::any_of(places,
                             [&](vec2 place) { return mayCover(edges, low, high, grid.size, place); });
}

}  // namespace

std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, const PictureGrid& grid) {
  return (seenOfTriangle(a, b, c, grid) ? 1u : 0u) | (seenOfTriangle(a, c, d, grid) ? 2u : 0u);
}

}  // namespace vasa
