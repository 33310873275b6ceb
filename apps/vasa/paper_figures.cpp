#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/cancellation.h"
#include "paper_easel.h"

// Figures 1, 3, 5 and 7: the whole body, the brain, kinds of capillaries, and stills.
namespace vasa::cli {
namespace {

constexpr std::uint32_t kLevels = 3;  // of capillaries, as in the paper

std::vector<char> everySpan(const Network& network) { return std::vector<char>(network.sweepCount(), 1); }

// Spans in which the rules of a region grow.
std::vector<char> spansOfRegion(const PaperStudy& study, std::string_view name) {
  std::vector<char> spans(study.scene.network.sweepCount(), 0);
  for (std::size_t span = 0; span < spans.size(); ++span) {
    const std::uint8_t region = study.growth.beds.regionOfSpan[span];
    spans[span] = region != 255 && study.growth.regions[region].name == name;
  }
  return spans;
}

// All of every vessel that has such a span.
std::vector<char> wholeVessels(const Network& network, std::span<const char> spans) {
  std::vector<char> whole;
  std::size_t first = 0;
  for (const Vessel& vessel : network.vessels()) {
    const auto own = spans.subspan(first, vessel.spanCount());
    whole.insert(whole.end(), vessel.spanCount(), char(std::ranges::find(own, 1) != own.end()));
    first += vessel.spanCount();
  }
  return whole;
}

bool hasAny(std::span<const char> spans) { return std::ranges::find(spans, 1) != spans.end(); }

// Those on the body's left: one hand of two.
std::vector<char> onTheLeft(const Network& network, std::vector<char> spans) {
  const float middle = boundsOf(network, everySpan(network)).centre().x;
  std::size_t span = 0;
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t s = 0; s < vessel.spanCount(); ++s, ++span)
      if (bezierOfSpan(network.pointsOf(vessel), s).at(0.5f).x < middle) spans[span] = 0;
  return spans;
}

}  // namespace

Result<PaperFigure> wholeBodyFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{
      "The whole-body network of blood vessels: (a) with and (b) without capillary vessels.", {}, {}, {}};
  const Network& network = study.scene.network;
  const Aabb box = boundsOf(network, everySpan(network));
  std::uint64_t curves = 0;
  for (const std::uint32_t levels : {kLevels, 0u}) {
    checkpoint();
    Easel easel(study, device,
                {.network = network,
                 .table = &study.table,
                 .growth = levels ? &study.growth : nullptr,
                 .capillaryLevels = levels},
                {420, 860});
    figure.panels.push_back(
        {levels ? "(a)" : "(b)", easel.draw(cameraOn(box, {0, 0, 1}, easel.aspect()), pageLook())});
    curves += easel.capillaries();
  }
  figure.facts = {{"capillaries", curves}, {"levels", kLevels}};
  return figure;
}

Result<PaperFigure> brainFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{"Blood vessels of the brain with three recursive levels of capillaries.", {}, {}, {}};
  const Network& network = study.scene.network;
  std::vector<char> spans = spansOfRegion(study, "brain");
  if (!hasAny(spans)) {
    spans = everySpan(network);
    figure.note = "No vessel of this network is named as a brain's: all of it is shown.";
  }
  const std::vector<char> shown = wholeVessels(network, spans);
  Report curves = Report::array();
  for (std::uint32_t levels = 1; levels <= kLevels; ++levels) {
    checkpoint();
    Easel easel(
        study, device,
        {.network = network, .table = &study.table, .growth = &study.growth, .capillaryLevels = levels},
        {420, 420});
    easel.showOnly(shown);
    figure.panels.push_back(
        {fmt::format("{} of 3", levels),
         easel.draw(cameraOn(boundsOf(network, spans), {0.9f, 0.25f, 0.45f}, easel.aspect()), pageLook())});
    curves.push_back(easel.capillaries());
  }
  figure.facts = {{"capillaries", curves}};
  return figure;
}

Result<PaperFigure> capillaryFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{"Kinds of capillary branching: brain, foot, hand and face.", {}, {}, {}};
  struct Place {
    const char* region;
    vec3 from;  // towards the camera
    bool oneSide;
  };
  constexpr std::array<Place, 4> places{{{"brain", {0.15f, 0.2f, 1}, false},
                                         {"foot", {0.9f, 0.5f, 0.7f}, true},
                                         {"hand", {0.1f, 0.05f, 1}, true},
                                         {"face", {0.35f, 0.05f, 1}, false}}};
  const Network& network = study.scene.network;
  Easel easel(
      study, device,
      {.network = network, .table = &study.table, .growth = &study.growth, .capillaryLevels = kLevels},
      {320, 320});
  for (const Place& place : places) {
    checkpoint();
    std::vector<char> spans = spansOfRegion(study, place.region);
    if (place.oneSide) spans = onTheLeft(network, std::move(spans));
    if (!hasAny(spans)) {
      figure.note += fmt::format("Nothing of this network grows as a {} does. ", place.region);
      continue;
    }
    easel.showOnly(wholeVessels(network, spans));
    figure.panels.push_back(
        {place.region,
         easel.draw(cameraOn(boundsOf(network, spans), place.from, easel.aspect()), pageLook())});
  }
  return figure;
}

}  // namespace vasa::cli
