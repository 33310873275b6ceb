#pragma once
#include <cstddef>
#include <string>

// What reading a file may take, so that a small file cannot ask for much: at its peak kMemoryTimes its bytes
// and kMemoryFree more, and time in proportion (5 s for 10 MB on one slow core). What would take more is
// refused as bad input, with the limit named; a file beside a .gltf counts with it, a packed mesh
// with what it unpacks to (io/gltf_unpack.h). Readers hold to it by
// having no step that costs more than n log n, and by checking amounts before memory is asked for;
// tests/fuzz/*_growth_test.cpp measure both.
namespace vasa {

inline constexpr std::size_t kMemoryTimes = 20, kMemoryFree = std::size_t(64) << 20;

/// A part of that: so many times a file's bytes and some more [bytes].
constexpr std::size_t partOfMemory(std::size_t fileBytes, std::size_t times, std::size_t freeMiB) {
  return times * fileBytes + (freeMiB << 20);
}

/// "would take 80 MB of memory, more than the 60 MB accepted for a file of this size"
inline std::string beyondMemory(std::size_t wanted, std::size_t accepted) {
  return "would take " + std::to_string(wanted / 1'000'000) + " MB of memory, more than the " +
         std::to_string(accepted / 1'000'000) + " MB accepted for a file of this size";
}

}  // namespace vasa
