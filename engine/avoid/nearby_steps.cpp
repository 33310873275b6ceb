#include "avoid/nearby_steps.h"

namespace vasa {
namespace {

constexpr std::uint32_t kBuckets = 1 << 12;

// Teschner et al. 2003. Cells that share a bucket only cost time.
std::uint32_t bucketOf(ivec3 cell) {
  const uvec3 c(cell);
  return (c.x * 73856093u ^ c.y * 19349663u ^ c.z * 83492791u) % kBuckets;
}

}  // namespace

// What is near lies in the same cell or a neighbouring one.
ivec3 NearbySteps::cellOf(vec3 place) const {
  constexpr float kOutermost = 1 << 20;  // beyond it cells have no number of their own
  return ivec3(glm::clamp(glm::floor(place / near_), -kOutermost, kOutermost));
}

void NearbySteps::fillBuckets() {
  // Counted one place too far on, so that each has come to its own first once all are put in.
  firsts_.assign(kBuckets + 2, 0);
  for (const Step& step : given_) ++firsts_[bucketOf(cellOf(step.place)) + 2];
  for (std::uint32_t bucket = 0; bucket < kBuckets; ++bucket) firsts_[bucket + 2] += firsts_[bucket + 1];
  steps_.resize(given_.size());
  for (const Step& step : given_) steps_[firsts_[bucketOf(cellOf(step.place)) + 1]++] = step;
}

float NearbySteps::longest(vec3 place, float enough) const {
  float found = least_;
  if (steps_.empty()) return found;
  const ivec3 middle = cellOf(place);
  for (int k = 0; k < 27 && found < enough; ++k) {
    const std::uint32_t bucket = bucketOf(middle + ivec3(k / 9, k / 3 % 3, k % 3) - 1);
    for (std::uint32_t s = firsts_[bucket]; s < firsts_[bucket + 1] && found < enough; ++s)
      if (steps_[s].length > found && glm::all(glm::lessThan(glm::abs(steps_[s].place - place), vec3(near_))))
        found = steps_[s].length;
  }
  return found;
}

}  // namespace vasa
