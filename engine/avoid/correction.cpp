#include "avoid/correction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/volume.h"
#include "core/ids.h"

namespace vasa {
namespace {

// [s] in which a correction falls to a third, and a lumen that gave way widens to the threefold where there
// is room again (widening in 0.3, what two bones hold between them had widened by a tenth before each step,
// and was dented a little more by each: 0.7 to 0.3 in a second). What is held aside goes into what holds it
// by that share before each step, and is pushed back; all by the same, so that what remains is the least
// correction (a bound on the speed, as there was at first, lets vessels creep along what holds them). In 0.1
// s, with at most 20 mm/s, the thinnest went by a radius: to which side they were to be pushed was a guess,
// so that a scanned body's steps were made in halves, in up to three times the time. 0.3 to 2 s were
// measured: the longer the faster, and the longer vessels lie aside for nothing.
constexpr float kFading = 1;

}  // namespace

CorrectionFlow::CorrectionFlow(const Network& network)
    : network_(&network), pointOf_(network.points().size()) {
  std::iota(pointOf_.begin(), pointOf_.end(), 0u);
  for (const Node& node : network.nodes())
    pointOf_.push_back(node.host || node.endCount == 0 ? kNone : network.pointOf(network.ends(node)[0]));
}

void CorrectionFlow::fade(float seconds, Correction& correction) const {
  const float left = kFading / (kFading + seconds);
  for (vec3& motion : correction.motions)
    motion = glm::length(left * motion) > Correction::kNegligible ? left * motion : vec3(0);
  const std::span<const vec4> rest = network_->points();
  for (std::size_t p = 0; p < rest.size(); ++p) {
    float& widest = correction.widest[p];
    widest *= std::exp(seconds / kFading);
    if (widest > VolumeKeeper::kHighestFactor * rest[p].w) widest = Correction::kNoLimit;
  }
}

// A lumen that is bounded in one of both only is bounded the less the farther that one is.
void CorrectionFlow::mix(const Correction& other, float share, Correction& correction) {
  for (std::size_t v = 0; v < correction.motions.size(); ++v)
    correction.motions[v] = glm::mix(other.motions[v], correction.motions[v], share);
  for (std::size_t p = 0; p < correction.widest.size(); ++p)
    correction.widest[p] = 1 / glm::mix(1 / other.widest[p], 1 / correction.widest[p], share);
}

void CorrectionFlow::carry(std::span<const quat> from, std::span<const quat> to,
                           std::span<vec3> motions) const {
  for (std::size_t v = 0; v < motions.size(); ++v)
    if (const std::uint32_t point = pointOf_[v]; motions[v] != vec3(0) && point != kNone)
      motions[v] = to[point] * (glm::conjugate(from[point]) * motions[v]);
}

}  // namespace vasa
