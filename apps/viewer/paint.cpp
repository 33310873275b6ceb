#include "viewer/paint.h"

#include <algorithm>

namespace vasa::viewer {
namespace {

constexpr vec4 kChosen{1, 0.74f, 0.10f, 1}, kRoute{0.15f, 0.75f, 0.35f, 1}, kQuiet{0.52f, 0.53f, 0.57f, 1},
    kTouched{1, 0.72f, 0, 1}, kTouching{0.95f, 0.05f, 0.05f, 1};

// Spans are numbered vessel after vessel.
std::vector<std::uint32_t> firstSpans(const Network& network) {
  std::vector<std::uint32_t> first(1, 0);
  for (const Vessel& vessel : network.vessels()) first.push_back(first.back() + vessel.spanCount());
  return first;
}

}  // namespace

const std::vector<std::uint32_t>& KeptColours::of(const Document& document,
                                                  std::shared_ptr<const PosedBody> body,
                                                  atlas::Colouring colouring) {
  if (body_ != body || colouring_ != colouring) {
    body_ = std::move(body);
    colouring_ = colouring;
    colours_ = atlas::spanColours(document.scene.network, *document.groups, body_->points, colouring);
  }
  return colours_;
}

std::vector<char> shownVessels(const Document& document, const ViewState& state) {
  const Network& network = document.scene.network;
  const bool single = state.isolate && state.selected;
  std::vector<char> shown(network.vessels().size(), !single);
  if (single)
    for (const VesselId vessel : treeBelow(network, state.selected->vessel)) shown[vessel.value] = 1;
  for (std::size_t v = 0; v < shown.size(); ++v)
    shown[v] = shown[v] && draws(state.look, network.vessels()[v].kind) &&
               !state.hidden.has(network.vessels()[v].name);
  return shown;
}

std::vector<std::uint32_t> coloursOf(const Document& document, std::shared_ptr<const PosedBody> body,
                                     const ViewState& state, KeptColours& plain) {
  const Network& network = document.scene.network;
  const bool single = state.isolate && state.selected;
  if (!state.selected && !state.contacts && !(state.from && state.to) && !state.hidden.any() &&
      state.colouring == atlas::Colouring::kind)
    return {};
  const std::vector<std::uint32_t> first = firstSpans(network);
  std::vector<std::uint32_t> colours = state.contacts ? std::vector(first.back(), packColour(kQuiet))
                                                      : plain.of(document, body, state.colouring);
  const auto paint = [&](VesselId vessel, std::uint32_t from, std::uint32_t to, vec4 colour) {
    std::fill(colours.begin() + first[vessel.value] + from, colours.begin() + first[vessel.value] + to,
              packColour(colour));
  };
  if (state.contacts) {
    for (const std::uint32_t span : body->touched) colours[span] = packColour(kTouched);
    for (const std::uint32_t span : body->touching) colours[span] = packColour(kTouching);
  }
  if (state.from && state.to)
    if (const auto route = RouteFinder(network, body->points).find(*state.from, *state.to))
      for (const Route::Leg& leg : route->legs) {
        const std::uint32_t spans = network.vessel(leg.vessel).spanCount();
        const auto [low, high] = std::minmax(leg.from, leg.to);
        paint(leg.vessel, std::min(std::uint32_t(low), spans - 1), std::min(std::uint32_t(high) + 1, spans),
              kRoute);
      }
  for (const VesselId vessel : chosenVessels(state))
    paint(vessel, 0, network.vessel(vessel).spanCount(), kChosen);
  if (single || state.hidden.any()) atlas::leaveOut(network, shownVessels(document, state), colours);
  return colours;
}

}  // namespace vasa::viewer
