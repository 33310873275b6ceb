#include "curve/arc_length.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr int kParts = 16;  // of a span

float speed(const Bezier& segment, float t) { return glm::length(vec3(segment.derivative(t))); }

}  // namespace

ArcLength::ArcLength(std::span<const vec4> points) : at_{0} {
  double sum = 0;
  for (std::uint32_t span = 0; span < spanCount(points); ++span) {
    const Bezier segment = bezierOfSpan(points, span);
    for (int k = 0; k < kParts; ++k) {
      const float from = float(k) / kParts, to = float(k + 1) / kParts;
      const float mean = speed(segment, from) + 4 * speed(segment, 0.5f * (from + to)) + speed(segment, to);
      sum += double(mean) / 6 / kParts;
      at_.push_back(float(sum));
    }
  }
}

float ArcLength::along(float parameter) const {
  const float place = std::clamp(parameter * kParts, 0.0f, float(at_.size() - 1));
  const std::size_t before = std::min(std::size_t(place), at_.size() - 2);
  return std::lerp(at_[before], at_[before + 1], place - float(before));
}

float ArcLength::parameterAt(float along) const {
  const auto after = std::upper_bound(at_.begin() + 1, at_.end() - 1, along);
  const float low = *(after - 1), high = *after;
  const float share = high > low ? std::clamp((along - low) / (high - low), 0.0f, 1.0f) : 0.0f;
  return (float(after - 1 - at_.begin()) + share) / kParts;
}

}  // namespace vasa
