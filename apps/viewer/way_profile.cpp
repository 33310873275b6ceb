#include "viewer/way_profile.h"

#include "network/route.h"

namespace vasa::viewer {
namespace {

constexpr float kStep = 1e-3f;  // [m]

}  // namespace

std::optional<WayProfile> profileOf(const ViewState& state, const Network& network,
                                    std::span<const vec4> points) {
  if (state.measuring) {
    if (!state.from || !state.to) return std::nullopt;
    const auto route = RouteFinder(network, points).find(*state.from, *state.to);
    if (!route) return std::nullopt;
    std::string title = network.vessel(state.from->vessel).name;
    if (state.from->vessel != state.to->vessel) title += " to " + network.vessel(state.to->vessel).name;
    return WayProfile{std::move(title), stationsAlong(network, points, *route, kStep), route->legs.size()};
  }
  if (!state.selected) return std::nullopt;
  const Vessel& vessel = network.vessel(state.selected->vessel);
  return WayProfile{vessel.name, stationsOf(Network::pointsOf(vessel, points), kStep)};
}

}  // namespace vasa::viewer
