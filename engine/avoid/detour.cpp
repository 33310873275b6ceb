#include "avoid/detour.h"

#include <algorithm>
#include <cmath>

#include "avoid/way.h"
#include "curve/fit.h"

namespace vasa {
namespace {

constexpr float kBeside = 4;            // spans that move before and behind what is in the way
constexpr float kSpareRoom = 1.5e-4f;   // [m]
constexpr std::uint32_t kSamples = 64;  // of a stretch
constexpr int kFits = 30, kPushes = 30;
constexpr float kALittleMore = 2e-5f;   // [m] a push

// A vessel some of whose points move.
class MovingVessel {
 public:
  MovingVessel(const Network& network, const Stretch& stretch, std::span<const vec4> points)
      : vessel_(network.vessel(stretch.vessel)), spans_(float(vessel_.spanCount())) {
    const std::span<const vec4> own = Network::pointsOf(vessel_, points);
    points_.assign(own.begin(), own.end());
    before_ = points_;
    first_ = std::max(std::floor(stretch.from) - kBeside, 0.0f);
    last_ = std::min(std::ceil(stretch.to) + kBeside, spans_);
    // Those that move nothing beyond, nor an end on a node.
    begin_ = std::uint32_t(first_) + (first_ > 0 ? 3 : vessel_.start.valid() ? 1 : 0);
    end_ = std::uint32_t(last_) + (last_ < spans_ ? 0 : vessel_.end.valid() ? 2 : 3);
  }

  bool canMove() const { return begin_ < end_; }
  std::uint32_t firstSpan() const { return std::uint32_t(first_); }
  std::uint32_t lastSpan() const { return std::uint32_t(std::ceil(last_)) - 1; }
  float parameter(std::uint32_t sample) const { return glm::mix(first_, last_, float(sample) / float(kSamples - 1)); }
  std::uint32_t spanOf(float u) const { return std::clamp(std::uint32_t(u), firstSpan(), lastSpan()); }
  vec3 at(float u) const { return vec3(bezierOfSpan(points_, spanOf(u)).at(u - float(spanOf(u)))); }
  float placeOf(std::uint32_t point) const { return float(greville(point, vessel_.spanCount())); }
  // @param wanted  the place of a parameter
  void fit(const auto& wanted) {
    std::vector<vec3> steps(end_ - begin_);
    for (int round = 0; round < kFits; ++round) {
      for (std::uint32_t l = begin_; l < end_; ++l) steps[l - begin_] = wanted(placeOf(l)) - at(placeOf(l));
      for (std::uint32_t l = begin_; l < end_; ++l) points_[l] += vec4(steps[l - begin_], 0);
    }
  }
  // Each point by the mean of what the samples that it moves want. @param wanted  of a sample; 0: nothing
  void push(const auto& wanted) {
    for (int round = 0; round < kPushes; ++round) {
      std::vector<vec4> steps(end_ - begin_, vec4(0));  // and weights
      for (std::uint32_t k = 0; k < kSamples; ++k) {
        const float u = parameter(k);
        const vec3 step = wanted(k, at(u));
        if (step == vec3(0)) continue;
        const std::uint32_t span = spanOf(u);
        const vec4 shares = deBoorWeights(span, vessel_.spanCount(), u - float(span));
        for (std::uint32_t i = 0; i < 4; ++i)
          if (span + i >= begin_ && span + i < end_) steps[span + i - begin_] += shares[int(i)] * vec4(step, 1);
      }
      bool any = false;
      for (std::uint32_t l = begin_; l < end_; ++l)
        if (const vec4& step = steps[l - begin_]; step.w > 0) points_[l] += vec4(vec3(step) / step.w, 0), any = true;
      if (!any) return;
    }
  }
  Detour motions(VesselId vessel) const {
    Detour detour{vessel, begin_, {}};
    for (std::uint32_t l = begin_; l < end_; ++l) detour.motions.emplace_back(vec3(points_[l] - before_[l]));
    return detour;
  }

 private:
  const Vessel& vessel_;
  float spans_, first_ = 0, last_ = 0;
  std::uint32_t begin_ = 0, end_ = 0;
  std::vector<vec4> points_, before_;
};

}  // namespace

Detour findDetour(const Network& network, const Interference& interference, const Bones& bones, const Stretch& stretch,
                  std::span<const vec4> points, float factor) {
  MovingVessel vessel(network, stretch, points);
  if (!vessel.canMove()) return {};
  const std::span<const vec4> atRest = network.pointsOf(network.vessel(stretch.vessel));
  StretchLine line;
  float widest = 0;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    const std::uint32_t span = vessel.spanOf(vessel.parameter(k));
    line.places.push_back(vessel.at(vessel.parameter(k)));
    line.tubes.push_back(interference.layout().tube(stretch.vessel, span));
    widest = std::max(widest, atRest[span + 1].w);
  }
  const float need = factor * widest + kSpareRoom;
  const Room room(bones, interference, line, kWayAside, 2 * need + kWayRoom);
  const std::vector<vec3> way = findWay(line, room, need);
  if (way.empty()) return {};
  const std::vector<float> places = placesAlong(way, line.places);
  const auto between = [](std::span<const auto> values, float place) {
    const auto k = std::min(std::size_t(place), values.size() - 2);
    return glm::mix(values[k], values[k + 1], place - float(k));
  };
  const float first = vessel.parameter(0), last = vessel.parameter(kSamples - 1);
  vessel.fit([&](float u) {
    const float sample = std::clamp((u - first) / (last - first), 0.0f, 1.0f) * float(kSamples - 1);
    return between(std::span<const vec3>(way), between(std::span<const float>(places), sample));
  });
  vessel.push([&](std::uint32_t sample, vec3 place) {
    const float lack = need - room.at(place, need, line.tubes[sample]);
    return lack > 0 ? (lack + kALittleMore) * room.slope(place, 2 * need, line.tubes[sample]) : vec3(0);
  });
  return vessel.motions(stretch.vessel);
}

}  // namespace vasa
