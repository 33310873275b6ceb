#include "surface/visible.h"

#include "shared/tubes.h"

// A corner moved by s in each coordinate moves the area that it spans with an edge and a sample inside their box by at
// most 3 s (width + height) + 2 s²; the margin is above that.
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

bool covers(vec4 outside, float margin) {
  return std::min(std::min(outside.x, outside.y), std::min(outside.z, outside.w)) <= margin;
}

bool seenOfTriangle(vec2 a, vec2 b, vec2 c, vec2 samples, float snap) {
  const vec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
  if (high.x >= 0.5f * shared::kBehind) return true;
  const vec2 first = glm::max(glm::ceil(low - snap), vec2(0)), last = glm::min(glm::floor(high + snap), samples - 1.0f);
  const vec2 span = last - first;
  if (span.x < 0 || span.y < 0) return false;
  const vec2 size = high - low, ab = b - a, ac = c - a;
  const float margin = 4 * snap * (size.x + size.y + snap);
  if (cross2(ab, ac) > margin) return false;
  if (span.x > 1 || span.y > 1) return true;
  // small: each of its samples is looked at
  return covers(glm::max(glm::max(beyond(a, ab, first, span), beyond(b, c - b, first, span)), beyond(c, -ac, first, span)), margin);
}

}  // namespace

std::uint32_t seenOfQuad(vec2 a, vec2 b, vec2 c, vec2 d, vec2 samples, float snap) {
  return (seenOfTriangle(a, b, c, samples, snap) ? 1u : 0u) | (seenOfTriangle(a, c, d, samples, snap) ? 2u : 0u);
}

}  // namespace vasa
