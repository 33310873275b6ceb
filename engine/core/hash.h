#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vasa {

/// 64-bit xxHash (XXH3) of raw bytes: checksums of files, hashes of results in tests and benchmarks.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);

template <class T>
std::uint64_t hashOf(std::span<const T> values, std::uint64_t seed = 0) {
  return hashBytes(std::as_bytes(values), seed);
}

/// A value, or a list and its length, on top of a hash.
template <class T>
std::uint64_t hashed(const T& value, std::uint64_t hash) {
  return hashOf(std::span<const T>(&value, 1), hash);
}
template <class T>
std::uint64_t hashedAll(const std::vector<T>& values, std::uint64_t hash) {
  return hashed(values.size(), hashOf(std::span<const T>(values), hash));
}

}  // namespace vasa
