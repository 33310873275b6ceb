#include "avoid/nearby_steps.h"

#include <algorithm>
#include <tuple>

namespace vasa {
namespace {

// A power of two, so that dividing by it rounds nothing; what is near lies in the same cell or a neighbouring
// one.
constexpr float kCell = 0.0625f;

// Places so far out that their cells have no number of their own share the outermost.
ivec3 cellOf(vec3 place) {
  constexpr float kOutermost = float(1 << 20) - 2;
  return ivec3(glm::clamp(glm::floor(place / kCell), -kOutermost, kOutermost));
}

std::uint64_t numberOf(ivec3 cell) {
  const auto axis = [](int c) { return std::uint64_t(c + (1 << 20)); };
  return axis(cell.x) << 42 | axis(cell.y) << 21 | axis(cell.z);
}

}  // namespace

void NearbySteps::add(vec3 place, float length) {
  steps_.push_back({numberOf(cellOf(place)), length, place});
}

void NearbySteps::sort() {
  std::ranges::sort(steps_, {}, [](const Step& step) { return std::tuple(step.cell, -step.length); });
}

float NearbySteps::longest(vec3 place, float enough) const {
  float found = least_;
  const ivec3 middle = cellOf(place);
  for (int k = 0; k < 27 && found < enough; ++k) {
    const std::uint64_t cell = numberOf(middle + ivec3(k / 9, k / 3 % 3, k % 3) - 1);
    for (auto step = std::ranges::lower_bound(steps_, cell, {}, &Step::cell);
         step != steps_.end() && step->cell == cell && step->length > found; ++step)
      if (glm::all(glm::lessThan(glm::abs(step->place - place), vec3(near_)))) found = step->length;
  }
  return found;
}

}  // namespace vasa
