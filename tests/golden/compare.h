#pragma once
#include <cstdint>

#include "core/image.h"

namespace vasa::golden {

/// How far two pictures of one size are apart, over the pixels that are not background in both: the
/// background is the first one's first pixel.
struct Difference {
  double mean = 0;        ///< of the channels' distances [0..255]
  double changed = 0;     ///< share of pixels with a channel further off than kVisible
  double foreground = 0;  ///< pixels compared
};
constexpr int kVisible = 24;
Difference compare(const Image& wanted, const Image& found);

/// What counts as the same picture: a device may round edges and colours in its own way, and nothing more.
/// The stored ones are of 8 sub-pixel bits; on a device of 4, Vulkan's least, a corner moves by up to a 16th
/// of a pixel, and hair-thin vessels on a small picture are all edge: 4 in the mean, 10 % changed
/// (SwiftShader: 3.8 and 9.2 % in the worst of them, 1.7 and 2.1 % in those of the human). A GPU rounds light
/// in its own way: 1.5 in the mean (NVIDIA H200: 1.14 in the worst, bones two pixels wide; 0.11 in the
/// median).
struct Drawn {
  std::uint32_t subPixelBits = 8;
  bool byGpu = false;
};
bool same(const Difference& difference, const Drawn& drawn = {});

}  // namespace vasa::golden
