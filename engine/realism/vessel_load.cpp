#include "realism/vessel_load.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "curve/arc_length.h"
#include "network/kinks.h"

namespace vasa {
namespace {

struct LoadWords {
  std::string_view name, unit;
};
constexpr std::array kWords{
    LoadWords{"kink", "radius by bending radius"}, LoadWords{"squeeze", "share of the area at rest"},
    LoadWords{"stretch", "% of the length at rest"}, LoadWords{"shortening", "% of the length at rest"},
    LoadWords{"bone", "mm deeper than at rest"}};

constexpr float kAdded = 0.05f;      // of r κ: a bend that a pose makes less sharper is that of the rest
constexpr float kShortest = 0.005f;  // [m] strain of a stub between two forks is their walls' matter

}  // namespace

std::string_view loadName(LoadKind kind) { return kWords[std::size_t(kind)].name; }
std::string_view loadUnit(LoadKind kind) { return kWords[std::size_t(kind)].unit; }

float VesselLoad::value(LoadKind kind) const {
  switch (kind) {
    case LoadKind::kink:
      return kink;
    case LoadKind::squeeze:
      return lumen;
    case LoadKind::stretch:
    case LoadKind::shortening:
      return 100 * strain;
    case LoadKind::bone:
      return 1e3f * depth;
  }
  return 0;
}

float VesselLoad::place(LoadKind kind) const {
  return kind == LoadKind::kink      ? kinkPlace
         : kind == LoadKind::squeeze ? lumenPlace
         : kind == LoadKind::bone    ? depthPlace
                                     : 0.5f;
}

float VesselLoad::severity(LoadKind kind, const LoadLimits& limits) const {
  switch (kind) {
    case LoadKind::kink:
      return kink / limits.kink;
    case LoadKind::squeeze:
      return (1 - lumen) / (1 - limits.lumen);
    case LoadKind::stretch:
      return std::max(strain, 0.0f) / limits.strain;
    case LoadKind::shortening:
      return std::max(-strain, 0.0f) / limits.strain;
    case LoadKind::bone:
      return depth / limits.depth;
  }
  return 0;
}

LoadMeter::LoadMeter(const Network& network) : network_(&network) {
  for (const Vessel& vessel : network.vessels()) {
    const auto own = network.pointsOf(vessel);
    lengths_.push_back(ArcLength(own).length());
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      bends_.push_back(sharpestBend(bezierOfSpan(own, span)));
  }
}

std::vector<VesselLoad> LoadMeter::run(std::span<const vec4> points, const Avoider& avoider) const {
  const auto vessels = network_->vessels();
  std::vector<VesselLoad> loads(vessels.size());
  std::vector<std::size_t> firstSpan{0};
  for (const Vessel& vessel : vessels) firstSpan.push_back(firstSpan.back() + vessel.spanCount());
  parallelFor(vessels.size(), 16, [&](std::size_t v) {
    const Vessel& vessel = vessels[v];
    const auto own = Network::pointsOf(vessel, points), rest = network_->pointsOf(vessel);
    VesselLoad& load = loads[v];
    const float spans = float(vessel.spanCount());
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      const Bezier posed = bezierOfSpan(own, span), before = bezierOfSpan(rest, span);
      if (const float bend = sharpestBend(posed);
          bend > bends_[firstSpan[v] + span] + kAdded && bend > load.kink)
        load.kink = bend, load.kinkPlace = (float(span) + 0.5f) / spans;
      const float share = posed.b[0].w / before.b[0].w;
      if (share * share < load.lumen) load.lumen = share * share, load.lumenPlace = float(span) / spans;
    }
    if (lengths_[v] > kShortest) load.strain = ArcLength(own).length() / lengths_[v] - 1;
  });
  for (const BoneContact& contact : avoider.inBones()) {
    if (!contact.enters()) continue;
    const auto [vessel, span] = avoider.layout().address(contact.tube);
    VesselLoad& load = loads[vessel.value];
    if (const float depth = contact.allowed - contact.f; depth > load.depth)
      load.depth = depth,
      load.depthPlace = (float(span) + contact.s) / float(network_->vessel(vessel).spanCount());
  }
  return loads;
}

}  // namespace vasa
