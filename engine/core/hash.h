#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace vasa {

/// 64-bit xxHash (XXH3) of raw bytes: checksums of files, hashes of results in tests and benchmarks.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);

template <class T>
std::uint64_t hashOf(std::span<const T> values, std::uint64_t seed = 0) {
  return hashBytes(std::as_bytes(values), seed);
}

}  // namespace vasa
