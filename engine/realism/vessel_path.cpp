#include "realism/vessel_path.h"

#include <algorithm>
#include <cmath>

#include "core/letters.h"
#include "curve/arc_length.h"
#include "io/csv.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr float kStep = 1e-3f;  // [m] finer than any published figure

}  // namespace

std::vector<vec4> VesselPath::places(const Network& network, std::span<const vec4> points) const {
  std::vector<vec4> places;
  for (const Station& station : stations)
    places.push_back(evaluate(Network::pointsOf(network.vessel(station.vessel), points), station.parameter));
  return places;
}

PathFinder::PathFinder(const Network& network) : network_(&network), routes_(network, network.points()) {}

Result<VesselPlace> PathFinder::landmark(std::string_view text) const {
  for (const std::string_view alternative : csv::split(text, '|')) {
    const auto parts = csv::split(alternative, '@');
    for (std::uint32_t v = 0; v < network_->vessels().size(); ++v) {
      const Vessel& vessel = network_->vessels()[v];
      if (!sameLetters(vessel.name, parts[0])) continue;
      const auto spans = float(vessel.spanCount());
      if (parts.size() == 1 || parts[1] == "start") {
        // A vessel may be laid from either end: its root is the one that hangs on a host, or else its first
        // point.
        const bool last = !vessel.start.valid() && vessel.end.valid() && network_->node(vessel.end).host;
        return VesselPlace{{v}, last ? spans : 0};
      }
      if (parts[1] == "end") return VesselPlace{{v}, spans};
      const Result<float> share = csv::parseNumber(parts[1]);
      if (!share || *share < 0 || *share > 1)
        return badInput(csv::quoted(alternative) + ": after @ comes start, end or a number from 0 to 1");
      return VesselPlace{{v}, *share * spans};
    }
  }
  return badInput("no vessel is called " + csv::quoted(text));
}

Result<VesselPath> PathFinder::find(std::string_view from, std::string_view to, float firstShare,
                                    float lastShare) const {
  const auto first = landmark(from), last = landmark(to);
  if (!first) return first.error();
  if (!last) return last.error();
  const auto route = routes_.find(*first, *last);
  if (!route || !(route->length > kStep))
    return badInput("no vessels lead from " + csv::quoted(from) + " to " + csv::quoted(to));
  const float begin = firstShare * route->length, length = (lastShare - firstShare) * route->length;
  const auto count = std::uint32_t(std::max(std::lround(length / kStep), 2l));
  VesselPath path;
  float before = 0;  // [m] of the route up to this leg
  std::uint32_t next = 0;
  for (std::size_t l = 0; l < route->legs.size(); ++l) {
    const Route::Leg& leg = route->legs[l];
    const ArcLength arc(network_->pointsOf(network_->vessel(leg.vessel)));
    const float start = arc.along(leg.from), end = arc.along(leg.to), own = std::abs(end - start);
    if (own < kStep * 1e-3f && l + 1 < route->legs.size())
      continue;  // a landmark's own first place is its host's
    for (; next <= count; ++next) {
      const float along = length * float(next) / float(count), here = begin + along - before;
      if (here > own && l + 1 < route->legs.size()) break;
      const float share = own > 0 ? std::min(here / own, 1.0f) : 0;
      path.stations.push_back({leg.vessel, arc.parameterAt(glm::mix(start, end, share)), along});
    }
    before += own;
  }
  return path;
}

}  // namespace vasa
