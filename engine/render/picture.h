#pragma once
#include <span>
#include <vector>

#include "core/image.h"
#include "math/types.h"

namespace vasa {

/// Between sRGB in [0, 1] and linear light; alpha stays as it is.
vec4 linearColour(vec4 srgb);
vec4 srgbColour(vec4 linear);

/// Means, in linear light, of the n x n pixels that stand for each of the picture's.
/// @param rgba  width · n by height · n pixels, sRGB, premultiplied
std::vector<std::uint8_t> averaged(std::span<const std::uint8_t> rgba, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t n);

void swapRedAndBlue(std::span<std::uint8_t> rgba);

/// The device's pixels (sRGB, premultiplied in linear light) as a picture with straight alpha.
/// @param transparent  otherwise alpha becomes 255
Image toImage(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height,
              bool transparent);

}  // namespace vasa
