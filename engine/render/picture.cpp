#include "render/picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace vasa {
namespace {

float linearOf(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

float srgbOf(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

const std::array<float, 256>& linearTable() {
  static const auto table = [] {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) values[i] = linearOf(float(i) / 255);
    return values;
  }();
  return table;
}

void straighten(std::uint8_t* pixel) {
  const std::uint8_t alpha = pixel[3];
  if (alpha == 0 || alpha == 255) return;
  for (int i = 0; i < 3; ++i) {
    const float straight = std::min(linearTable()[pixel[i]] * 255 / float(alpha), 1.0f);
    pixel[i] = std::uint8_t(srgbOf(straight) * 255 + 0.5f);
  }
}

}  // namespace

vec4 linearColour(vec4 srgb) { return {linearOf(srgb.x), linearOf(srgb.y), linearOf(srgb.z), srgb.w}; }

vec4 srgbColour(vec4 linear) { return {srgbOf(linear.x), srgbOf(linear.y), srgbOf(linear.z), linear.w}; }

std::vector<std::uint8_t> averaged(std::span<const std::uint8_t> rgba, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t n) {
  assert(rgba.size() == std::size_t(4) * width * n * height * n);
  std::vector<std::uint8_t> result(std::size_t(4) * width * height);
  const float share = 1 / float(n * n);
  parallelFor(height, 16, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      vec4 sum(0);
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const std::uint8_t* p = &rgba[4 * ((y * n + j) * width * n + x * n + i)];
          sum += vec4(linearTable()[p[0]], linearTable()[p[1]], linearTable()[p[2]], p[3]);
        }
      std::uint8_t* out = &result[4 * (y * width + x)];
      for (int k = 0; k < 3; ++k) out[k] = std::uint8_t(srgbOf(sum[k] * share) * 255 + 0.5f);
      out[3] = std::uint8_t(sum.w * share + 0.5f);
    }
  });
  return result;
}

void swapRedAndBlue(std::span<std::uint8_t> rgba) {
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) std::swap(rgba[i], rgba[i + 2]);
}

Image toImage(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height,
              bool transparent) {
  assert(rgba.size() == std::size_t(4) * width * height);
  Image image{width, height, {rgba.begin(), rgba.end()}};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    if (transparent)
      straighten(&image.rgba[i]);
    else
      image.rgba[i + 3] = 255;
  }
  return image;
}

}  // namespace vasa
