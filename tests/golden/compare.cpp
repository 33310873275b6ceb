#include "golden/compare.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace vasa::golden {

Difference compare(const Image& wanted, const Image& found) {
  if (wanted.width != found.width || wanted.height != found.height) return {255, 1, 1};
  Difference difference;
  const std::uint8_t* background = wanted.rgba.data();
  for (std::size_t i = 0; i < wanted.rgba.size(); i += 4) {
    const std::uint8_t *a = &wanted.rgba[i], *b = &found.rgba[i];
    if (std::memcmp(a, background, 4) == 0 && std::memcmp(b, background, 4) == 0) continue;
    int largest = 0;
    for (int k = 0; k < 4; ++k) {
      const int distance = std::abs(int(a[k]) - int(b[k]));
      difference.mean += distance;
      largest = std::max(largest, distance);
    }
    difference.changed += largest > kVisible;
    ++difference.foreground;
  }
  if (difference.foreground == 0) return difference;
  difference.mean /= 4 * difference.foreground;
  difference.changed /= difference.foreground;
  return difference;
}

bool same(const Difference& difference, const Drawn& drawn) {
  const bool coarse = drawn.subPixelBits < 8;
  const double mostMean = coarse ? 4 : drawn.byGpu ? 1.5 : 1, mostChanged = coarse ? 0.1 : 0.01;
  return difference.foreground > 100 && difference.mean <= mostMean && difference.changed <= mostChanged;
}

}  // namespace vasa::golden
