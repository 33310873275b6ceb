#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/types.h"

namespace vasa::viewer {

struct Rect {
  float left = 0, top = 0, width = 0, height = 0;  ///< [pixels]
  bool operator==(const Rect&) const = default;
  bool holds(vec2 place) const {
    return place.x >= left && place.y >= top && place.x < left + width && place.y < top + height;
  }
};

/// How the window is shared out: the bar of menus and tools above, the picture, the list of vessels left of
/// it, the panels right of it, the clip's time below, under the panels, too, where the window is narrow.
struct Layout {
  Rect picture, panels, transport, outliner, bar;
};

/// @param scale  pixels for one of an ordinary screen
inline Layout layoutOf(float width, float height, float scale, bool panels, bool outliner) {
  const float side = panels ? glm::min(std::round(320 * scale), width / 2) : 0;
  const float below = panels ? glm::min(std::round(46 * scale), height / 3) : 0;
  const float above = panels ? glm::min(std::round(30 * scale), height / 3) : 0;
  const float list = outliner ? glm::min(std::round(270 * scale), (width - side) / 2) : 0;
  const float across = glm::max(width - side, 1.0f), down = glm::max(height - above - below, 1.0f);
  const bool narrow = across < 400 * scale;
  return {.picture = {list, above, glm::max(across - list, 1.0f), down},
          .panels = {across, above, side, narrow ? down : height - above},
          .transport = {0, above + down, narrow ? width : across, below},
          .outliner = {0, above, list, down},
          .bar = {0, 0, width, above}};
}

/// [pixels] that a window is drawn with: its own size or, where that is more than a device can take, the
/// largest of its shape that is not.
/// @param side, count  pixels along a side, and in all, that a device can take
inline uvec2 drawnSize(uvec2 window, std::uint32_t side, std::uint64_t count) {
  const glm::dvec2 size(window);
  if (size.x * size.y == 0) return window;
  const double share =
      std::min({1.0, side / std::max(size.x, size.y), std::sqrt(double(count) / (size.x * size.y))});
  return glm::max(uvec2(share * size), uvec2(1));
}

}  // namespace vasa::viewer
