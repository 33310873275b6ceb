#include "surface/octahedral.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

float signOf(float value) { return value < 0 ? -1.0f : 1.0f; }

std::uint32_t toSnorm16(float value) {
  return std::uint32_t(int(std::floor(std::clamp(value, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 0xffffu;
}

float fromSnorm16(std::uint32_t bits) {
  return std::max(float(std::int16_t(bits & 0xffffu)) / 32767.0f, -1.0f);
}

}  // namespace

std::uint32_t packOctahedral(vec3 unit) {
  const float size = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
  float x = unit.x / size, y = unit.y / size;
  if (unit.z < 0) {
    const float foldedX = (1 - std::abs(y)) * signOf(x);
    y = (1 - std::abs(x)) * signOf(y);
    x = foldedX;
  }
  return toSnorm16(x) | toSnorm16(y) << 16;
}

vec3 unpackOctahedral(std::uint32_t packed) {
  const float x = fromSnorm16(packed), y = fromSnorm16(packed >> 16);
  const float z = 1 - std::abs(x) - std::abs(y);
  const float fold = std::max(-z, 0.0f);
  return glm::normalize(vec3(x - signOf(x) * fold, y - signOf(y) * fold, z));
}

}  // namespace vasa
