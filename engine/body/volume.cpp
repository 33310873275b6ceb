#include "body/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "math/quadrature.h"

// With δ(u) the spline of the coefficients w_l r_l and g = |C'(u)|,
//   V(λ) = π ∫ (r + λδ)² g = aλ² + bλ + V,   a = π ∫ δ² g,   b = 2π ∫ r δ g,
// so V(λ) = V0 at λ = -2 (V - V0) / (b + √(b² - 4a (V - V0))), the root that is 0 when V = V0.

namespace vasa {
namespace {

constexpr double kNegligibleError = 2e-5;  // of the volume

struct Quadratic {
  double a = 0, b = 0, volume = 0;
  double at(double lambda) const { return (a * lambda + b) * lambda + volume; }
};

// A place of a span for the quadrature: what its four de Boor points weigh in C and in C', and its share of
// an integral over u.
struct Place {
  vec4 weights, slopes;
  float share;
};
using Places = std::array<Place, kGauss4.size()>;

// They depend on how near the ends are, no farther than two spans (curve/bspline.cpp).
const Places& placesOf(std::uint32_t span, std::uint32_t spans) {
  constexpr std::uint32_t kNearEnds = 2;
  static const auto places = [] {
    std::array<std::array<Places, kNearEnds + 1>, kNearEnds + 1> table{};
    for (std::uint32_t before = 0; before <= kNearEnds; ++before)
      for (std::uint32_t behind = 0; behind <= kNearEnds; ++behind) {
        const mat4 matrix = spanToBezier(before, before + 1 + behind);
        for (std::size_t k = 0; k < kGauss4.size(); ++k) {
          const auto [t, weight] = kGauss4[k];
          table[before][behind][k] = {bernstein(t) * matrix, bernsteinDerivative(t) * matrix, kPi * weight};
        }
      }
    return table;
  }();
  return places[std::min(span, kNearEnds)][std::min(spans - 1 - span, kNearEnds)];
}

// @param weightOf  w_l r_l of the vessel's point l
template <class Weight>
Quadratic quadraticOf(const Vessel& vessel, std::span<const vec4> points, const Weight& weightOf) {
  Quadratic q;
  const std::uint32_t spans = vessel.spanCount();
  for (std::uint32_t span = 0; span < spans; ++span) {
    const vec4* const own = &points[span];
    const vec4 radii(own[0].w, own[1].w, own[2].w, own[3].w),
        deltas(weightOf(span), weightOf(span + 1), weightOf(span + 2), weightOf(span + 3));
    // From one another, not from the origin (slopes sum to 0): coordinates of a metre would round by more
    // than a thousandth of a span of a tenth of a millimetre.
    const std::array<vec3, 3> ways{vec3(own[1]) - vec3(own[0]), vec3(own[2]) - vec3(own[0]),
                                   vec3(own[3]) - vec3(own[0])};
    for (const auto& [w, slopes, share] : placesOf(span, spans)) {
      const vec3 along = slopes.y * ways[0] + slopes.z * ways[1] + slopes.w * ways[2];
      const double r = glm::dot(w, radii), d = glm::dot(w, deltas), g = share * glm::length(along);
      q.a += g * d * d;
      q.b += g * 2 * r * d;
      q.volume += g * r * r;
    }
  }
  return q;
}

}  // namespace

VolumeKeeper::VolumeKeeper(const Network& network, Keep keep) : network_(&network), keep_(keep) {
  for (const Vessel& vessel : network.vessels())
    restVolumes_.push_back(
        quadraticOf(vessel, network.pointsOf(vessel), [](std::uint32_t) { return 0.0f; }).volume);
}

VolumeKeeper::Range VolumeKeeper::rangeOf(VesselKind kind, Keep keep) {
  if (keep != Keep::wall) return {kLowestFactor, kHighestFactor};
  if (kind == VesselKind::artery) return {0.9f, 1.1f};
  return {kLowestFactor, 1};
}

void VolumeKeeper::Outcome::add(const Outcome& other) {
  largestError = std::max(largestError, other.largestError);
  clampedError = std::max(clampedError, other.clampedError);
  clampedCount += other.clampedCount;
}

VolumeKeeper::Outcome VolumeKeeper::run(std::span<vec4> points, std::span<const float> most) const {
  Memory none;
  return run(points, most, none);
}

VolumeKeeper::Outcome VolumeKeeper::run(std::span<vec4> points, std::span<const float> most,
                                        Memory& last) const {
  const bool known = last.given.size() == points.size() && last.most.size() == most.size();
  if (!known)
    last.given.resize(points.size()), last.radii.resize(points.size()), last.most.resize(most.size());
  last.outcomes.resize(restVolumes_.size());
  parallelFor(restVolumes_.size(), 64, [&](std::size_t v) {
    const Vessel& vessel = network_->vessels()[v];
    const auto ofVessel = [&vessel](auto values) {
      return values.empty() ? values : values.subspan(vessel.firstPoint, vessel.pointCount);
    };
    const auto own = ofVessel(points), given = ofVessel(std::span(last.given));
    const auto limits = ofVessel(most);
    const auto lastLimits = ofVessel(std::span(last.most)), radii = ofVessel(std::span(last.radii));
    if (known && std::ranges::equal(own, given) && std::ranges::equal(limits, lastLimits)) {
      for (std::size_t l = 0; l < own.size(); ++l) own[l].w = radii[l];
      return;
    }
    std::ranges::copy(own, given.begin());
    std::ranges::copy(limits, lastLimits.begin());
    keep({std::uint32_t(v)}, points, most, last.outcomes[v] = {});
    std::ranges::transform(own, radii.begin(), [](const vec4& point) { return point.w; });
  });
  Outcome all;
  for (const Outcome& own : last.outcomes) all.add(own);
  return all;
}

void VolumeKeeper::keep(VesselId id, std::span<vec4> points, std::span<const float> most,
                        Outcome& outcome) const {
  const Vessel& vessel = network_->vessel(id);
  const double restVolume = restVolumes_[id.value];
  const Range range = rangeOf(vessel.kind, keep_);
  const auto own = Network::pointsOf(vessel, points);
  const auto rest = network_->pointsOf(vessel);
  const auto limit = [&](std::uint32_t l) {
    return most.empty() ? std::numeric_limits<float>::infinity() : most[vessel.firstPoint + l];
  };
  // A point that has come to its limit stays there, and the others share what it lacks.
  const auto held = [&](std::uint32_t l) { return vessel.isPinned(l) || own[l].w >= limit(l); };
  for (std::uint32_t l = 0; l < vessel.pointCount && !most.empty(); ++l)
    if (!vessel.isPinned(l)) own[l].w = std::min(own[l].w, limit(l));
  for (bool settled = false; !settled;) {
    settled = true;
    const Quadratic q = quadraticOf(vessel, own, [&](std::uint32_t l) { return held(l) ? 0.0f : own[l].w; });
    const double excess = q.volume - restVolume;
    const double discriminant = q.b * q.b - 4 * q.a * excess;
    double lambda = excess > 0 ? -1 : 1;  // no root: as thin, or as wide, as it gets
    if (discriminant >= 0 && q.b > 0) lambda = -2 * excess / (q.b + std::sqrt(discriminant));
    double kept = lambda;
    for (std::uint32_t l = 0; l < vessel.pointCount; ++l) {
      if (held(l)) continue;
      const double now = own[l].w;
      if (now > 0)
        kept = std::clamp(kept, range.lowest * rest[l].w / now - 1,
                          std::max(range.highest * rest[l].w / now - 1, 0.0));
    }
    for (std::uint32_t l = 0; l < vessel.pointCount; ++l) {
      if (held(l)) continue;
      const float wanted = own[l].w * float(1 + kept);
      if (wanted > limit(l)) settled = false;
      own[l].w = std::min(wanted, limit(l));
    }
    if (!settled) continue;
    const double error = restVolume > 0 ? std::abs(q.at(kept) - restVolume) / restVolume : 0;
    const bool clamped = error > kNegligibleError;
    outcome.clampedCount += clamped;
    float& worst = clamped ? outcome.clampedError : outcome.largestError;
    worst = std::max(worst, float(error));
  }
}

}  // namespace vasa
