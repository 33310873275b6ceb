#pragma once
#include <cstdint>

#include "math/types.h"

namespace vasa {

/// A unit vector in 32 bits: octahedral map (Meyer, Süßmuth, Sußner, Stamminger, Greiner 2010), x in the low
/// and y in the high half, signed 16-bit normalised. Off by less than 7e-5 radians.
std::uint32_t packOctahedral(vec3 unit);
vec3 unpackOctahedral(std::uint32_t packed);

}  // namespace vasa
