#pragma once
#include <algorithm>
#include <cmath>

#include "core/image.h"
#include "math/types.h"

namespace vasa::plate {

/// A white picture to draw a chart on. [pixels]
inline Image blank(int width, int height) {
  return {std::uint32_t(width), std::uint32_t(height),
          std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 4, 255)};
}

/// A rectangle, right and bottom not included; what lies beyond the picture is left out. @param colour  sRGB
inline void fill(Image& picture, int left, int top, int right, int bottom, vec3 colour) {
  for (int y = std::max(top, 0); y < std::min(bottom, int(picture.height)); ++y)
    for (int x = std::max(left, 0); x < std::min(right, int(picture.width)); ++x)
      for (int c = 0; c < 3; ++c)
        picture.rgba[4 * (std::size_t(y) * picture.width + std::size_t(x)) + std::size_t(c)] =
            std::uint8_t(std::lround(255 * colour[c]));
}

}  // namespace vasa::plate
