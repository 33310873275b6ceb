#pragma once
#include "core/image.h"

namespace vasa::golden {

/// How far two pictures of one size are apart, over the pixels that are not background in both: the background is the
/// first one's first pixel.
struct Difference {
  double mean = 0;       ///< of the channels' distances [0..255]
  double changed = 0;    ///< share of pixels with a channel further off than kVisible
  double foreground = 0; ///< pixels compared
};
constexpr int kVisible = 24;
Difference compare(const Image& wanted, const Image& found);

/// What counts as the same picture: a device may round edges and colours in its own way, and nothing more.
bool same(const Difference& difference);

}  // namespace vasa::golden
