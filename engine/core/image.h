#pragma once
#include <cstdint>
#include <vector>

namespace vasa {

/// A picture in memory: rows from the top, 4 bytes a pixel (red, green, blue, alpha; sRGB; alpha straight).
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 · width · height
};

}  // namespace vasa
