#include "avoid/nearby_steps.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace vasa {
namespace {

// A power of two, so that dividing by it rounds nothing; what is near lies in the same cell or a neighbouring
// one.
constexpr float kCell = 0.0625f;
constexpr float kLongest = std::numeric_limits<float>::infinity();

// Places so far out (32 m) that their cells have no number of their own share the outermost.
ivec3 cellOf(vec3 place) {
  constexpr float kOutermost = float(1 << 9) - 2;
  return ivec3(glm::clamp(glm::floor(place / kCell), -kOutermost, kOutermost));
}

// Sorts by cells, and within a cell by length, the longest first.
std::uint64_t keyOf(ivec3 cell, float length) {
  const auto axis = [](int c) { return std::uint64_t(c + (1 << 9)); };
  return axis(cell.x) << 52 | axis(cell.y) << 42 | axis(cell.z) << 32 |
         std::uint32_t(~std::bit_cast<std::uint32_t>(length));
}

}  // namespace

void NearbySteps::add(vec3 place, float length) {
  steps_.push_back({keyOf(cellOf(place), length), length, place});
}

void NearbySteps::sort() { std::ranges::sort(steps_, {}, &Step::key); }

float NearbySteps::longest(vec3 place, float enough) const {
  float found = least_;
  const ivec3 middle = cellOf(place);
  for (int k = 0; k < 27 && found < enough; ++k) {
    const ivec3 cell = middle + ivec3(k / 9, k / 3 % 3, k % 3) - 1;
    const std::uint64_t last = keyOf(cell, 0);
    for (auto step = std::ranges::lower_bound(steps_, keyOf(cell, kLongest), {}, &Step::key);
         step != steps_.end() && step->key <= last && step->length > found; ++step)
      if (glm::all(glm::lessThan(glm::abs(step->place - place), vec3(near_)))) found = step->length;
  }
  return found;
}

}  // namespace vasa
