#include "network/kinks.h"

#include <algorithm>
#include <limits>

namespace vasa {
namespace {

constexpr int kSamples = 8;
constexpr int kPasses = 2;
constexpr float kShare = 0.5f;  // of the way to the neighbours' middle, a pass
// R κ from which a span is drawn straight, the more the more it bends: continuous in the pose.
constexpr float kBends = 0.6f;

// |C''| <= 6 max|Δ²b|, and |C'| is at least three times the control polygon's least advance along the chord.
bool surelyBelow(const Bezier& tube, float limit) {
  const vec3 chord = vec3(tube.b[3] - tube.b[0]);
  const float length = glm::length(chord);
  if (!(length > 0)) return false;
  float advance = std::numeric_limits<float>::infinity(), bend = 0, radius = tube.b[0].w;
  for (std::size_t k = 0; k < 3; ++k) {
    advance = std::min(advance, glm::dot(vec3(tube.b[k + 1] - tube.b[k]), chord) / length);
    radius = std::max(radius, tube.b[k + 1].w);
  }
  for (std::size_t k = 0; k < 2; ++k)
    bend = std::max(bend, glm::length(vec3(tube.b[k] - 2.0f * tube.b[k + 1] + tube.b[k + 2])));
  return advance > 0 && radius * 6 * bend < limit * 9 * advance * advance;
}

// The largest r κ in nine places, 0 where it is surely below a limit.
float bendOf(const Bezier& tube, float limit) {
  if (surelyBelow(tube, limit)) return 0;
  float most = 0;
  for (int k = 0; k <= kSamples; ++k) {
    const float t = float(k) / kSamples;
    const vec3 first(tube.derivative(t)), second(tube.secondDerivative(t));
    const float speed = glm::length(first), turn = tube.at(t).w * glm::length(glm::cross(first, second));
    if (turn > 0) most = std::max(most, turn / (speed * speed * speed));
  }
  return most;
}

}  // namespace

float sharpestBend(const Bezier& tube) { return bendOf(tube, 0); }

bool kinks(const Bezier& tube) { return bendOf(tube, 1) >= 1; }

std::uint32_t kinkCount(const Network& network, std::span<const vec4> points) {
  std::uint32_t count = 0;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) count += kinks(bezierOfSpan(own, span));
  }
  return count;
}

KinkRelaxer::KinkRelaxer(const Network& network) : network_(&network) {
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      atRest_.push_back(bendOf(bezierOfSpan(network.pointsOf(vessel), span), kBends));
}

std::uint32_t KinkRelaxer::run(std::span<vec4> points) const {
  std::uint32_t found = 0;
  std::size_t first = 0;                          // span of the vessel
  static thread_local std::vector<float> shares;  // kept, so that a frame allocates nothing
  for (const Vessel& vessel : network_->vessels()) {
    const auto own = Network::pointsOf(vessel, points);
    // What share of the way a span is drawn straight: more than at rest, and none yet at kBends. It is asked
    // once: a fold that is drawn in becomes sharper at first, and to ask again would let it run away.
    const auto shareOf = [&](std::uint32_t span, float bend) {
      return kShare * std::clamp(bend - std::max(kBends, atRest_[first + span]), 0.0f, 1.0f);
    };
    shares.clear();
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      const float bend = bendOf(bezierOfSpan(std::span<const vec4>(own), span), kBends);
      shares.push_back(shareOf(span, bend));
      found += bend >= 1 && atRest_[first + span] < 1;
    }
    const bool any = std::ranges::any_of(shares, [](float share) { return share > 0; });
    for (int pass = 0; any && pass < kPasses; ++pass)
      for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
        for (std::uint32_t l = std::max(span, 1u);
             shares[span] > 0 && l < std::min(span + 4, vessel.pointCount - 1); ++l) {
          if (vessel.isPinned(l)) continue;
          const vec3 middle = 0.5f * (vec3(own[l - 1]) + vec3(own[l + 1]));
          own[l] = vec4(glm::mix(vec3(own[l]), middle, shares[span]), own[l].w);
        }
    first += vessel.spanCount();
  }
  return found;
}

}  // namespace vasa
