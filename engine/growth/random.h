#pragma once
#include <cstdint>

namespace vasa {

/// Random numbers out of an address alone, alike on every device: PCG (Jarzynski and Olano 2020).
/// Mirrored by shaders/lib/growth.glsl.
constexpr std::uint32_t scramble(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

/// The key of a part of what `key` names.
constexpr std::uint32_t keyOf(std::uint32_t key, std::uint32_t part) {
  return scramble(key ^ scramble(part + 0x9e3779b9u));
}

/// The upper 24 bits as a number in [0, 1), exactly.
constexpr float unitFloat(std::uint32_t bits) { return float(bits >> 8) * (1.0f / 16777216.0f); }

/// The n-th random number in [0, 1) that belongs to a key, and one in [-1, 1).
constexpr float unitOf(std::uint32_t key, std::uint32_t n) {
  return unitFloat(scramble(key + n * 0x85ebca6bu));
}
constexpr float signedOf(std::uint32_t key, std::uint32_t n) { return 2 * unitOf(key, n) - 1; }

}  // namespace vasa
