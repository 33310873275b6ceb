#pragma once
#include "core/hash.h"
#include "core/image.h"

namespace vasa::test {

inline std::uint64_t hashOfPicture(const Image& image) {
  return hashOf(std::span<const std::uint8_t>(image.rgba));
}

/// Pixels of it that something was drawn on.
inline std::size_t covered(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) count += image.rgba[i] > 0;
  return count;
}

}  // namespace vasa::test
