#pragma once
#include <random>
#include <vector>

#include "curve/bezier.h"

namespace vasa::test {

/// A tube along a line, as wide everywhere.
inline Bezier straight(vec3 from, vec3 to, float radius) {
  Bezier tube;
  for (int k = 0; k < 4; ++k) tube.b[std::size_t(k)] = vec4(glm::mix(from, to, float(k) / 3), radius);
  return tube;
}

/// Tubes thrown at random into a cube of the given side.
/// @param length  of the chord, about;  @param radius  largest
inline std::vector<Bezier> randomTubes(std::uint32_t count, std::uint32_t seed, float side, float length,
                                       float radius) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto vector = [&] { return vec3{unit(random), unit(random), unit(random)}; };
  std::vector<Bezier> tubes(count);
  for (Bezier& tube : tubes) {
    const vec3 start = side * vector(), step = length * (vector() - 0.5f);
    for (int k = 0; k < 4; ++k) {
      const vec3 place = start + float(k) / 3 * step + 0.3f * length * (vector() - 0.5f);
      tube.b[std::size_t(k)] = vec4(place, radius * (0.3f + 0.7f * unit(random)));
    }
  }
  return tubes;
}

}  // namespace vasa::test
