#include "surface/visible.h"

#include "shared/tubes.h"

// However its corners move by s at most in each coordinate, a triangle stays within itself widened by a square of 2 s, and
// so behind its own edges moved outwards by s (|x| + |y|) of the edge, in units of twice an area. Its own area moves by less
// than 4 s (width + height + s).
namespace vasa {
namespace {

float cross2(vec2 a, vec2 b) {
  return a.x * b.y - a.y * b.x;
}

// Twice the areas of (p, p + edge, sample) for four samples: above 0 beyond the edge of a front, as y points down.
vec4 beyond(vec2 p, vec2 edge, vec2 first, vec2 span) {
  const float at = cross2(edge, first - p), alongX = -edge.y * span.x, alongY = edge.x * span.y;
  return {at, at + alongX, at + alongY, at + alongX + alongY};
}

// The same beyond the edge moved outwards as far as its ends may be.
vec4 wellBeyond(vec2 p, vec2 edge, vec2 first, vec2 span, float snap) {
  return beyond(p, edge, first, span) - snap * (std::abs(edge.x) + std::abs(edge.y));
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, vec2 samples, float snap) {
  const vec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
  if (high.x >= 0.5f * shared::kBehind) return true;
  const vec2 first = glm::max(glm::ceil(low - snap), vec2(0)), last = glm::min(glm::floor(high + snap), samples - 1.0f);
  const vec2 span = last - first;
  if (span.x < 0 || span.y < 0) return false;
  const vec2 size = high - low, ab = b - a, bc = c - b, ca = a - c;
  if (cross2(ab, bc) > 4 * snap * (size.x + size.y + snap)) return false;
  if (span.x > 1 || span.y > 1) return true;
  // small: each of its samples is looked at
  const vec4 outside = glm::max(glm::max(wellBeyond(a, ab, first, span, snap), wellBeyond(b, bc, first, span, snap)),
                                wellBeyond(c, ca, first, span, snap));
  return std::min(std::min(outside.x, outside.y), std::min(outside.z, outside.w)) <= 0;
}

}  // namespace

std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap) {
  return (seenOfTriangle(a, b, c, samples, snap) ? 1u : 0u) | (seenOfTriangle(a, c, d, samples, snap) ? 2u : 0u);
}

}  // namespace vasa
