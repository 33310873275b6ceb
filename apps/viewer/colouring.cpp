#include "viewer/colouring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve/bspline.h"
#include "render/look.h"

namespace vasa::viewer {
namespace {

// Between colours that lie evenly from 0 to 1.
template <std::size_t N>
vec3 blend(const std::array<vec3, N>& colours, float share) {
  const float at = std::clamp(share, 0.0f, 1.0f) * float(N - 1);
  const std::size_t first = std::min(std::size_t(at), N - 2);
  return glm::mix(colours[first], colours[first + 1], at - float(first));
}

// [m] of each span, by four chords.
void addLengths(std::span<const vec4> points, std::uint32_t spans, std::vector<float>& lengths) {
  constexpr int kChords = 4;
  vec3 before(evaluate(points, 0));
  for (std::uint32_t span = 0; span < spans; ++span) {
    float length = 0;
    for (int i = 1; i <= kChords; ++i) {
      const vec3 here(evaluate(points, float(span) + float(i) / kChords));
      length += glm::distance(before, here);
      before = here;
    }
    lengths.push_back(length);
  }
}

std::vector<float> spanLengths(const Network& network, std::span<const vec4> points) {
  std::vector<float> lengths;
  for (const Vessel& vessel : network.vessels())
    addLengths(Network::pointsOf(vessel, points), vessel.spanCount(), lengths);
  return lengths;
}

std::vector<LegendEntry> kindsOf(const Document& document) {
  std::vector<LegendEntry> entries;
  for (const VesselKind kind : {VesselKind::artery, VesselKind::vein, VesselKind::portalVein,
                                VesselKind::lymphatic, VesselKind::other})
    if (std::ranges::find(document.scene.network.vessels(), kind, &Vessel::kind) !=
        document.scene.network.vessels().end())
      entries.push_back({vec3(colourOf(kind)), std::string(kindName(kind))});
  return entries;
}

std::vector<LegendEntry> regionsOf(const Document& document) {
  std::vector<LegendEntry> entries;
  for (std::size_t r = 0; r < kRegionNames.size(); ++r)
    if (std::ranges::find(document.groups->region, BodyRegion(r)) != document.groups->region.end())
      entries.push_back({regionColour(BodyRegion(r)), std::string(kRegionNames[r])});
  return entries;
}

}  // namespace

vec3 radiusColour(float radius) {
  static constexpr std::array kColours{vec3(0.27f, 0.00f, 0.33f), vec3(0.23f, 0.32f, 0.55f),
                                       vec3(0.13f, 0.57f, 0.55f), vec3(0.37f, 0.79f, 0.38f),
                                       vec3(0.99f, 0.91f, 0.14f)};
  return blend(kColours,
               std::log(std::max(radius, 1e-6f) / kLeastRadius) / std::log(kMostRadius / kLeastRadius));
}

vec3 strainColour(float strain) {
  static constexpr std::array kColours{vec3(0.07f, 0.25f, 0.65f), vec3(0.45f, 0.65f, 0.92f),
                                       vec3(0.82f, 0.82f, 0.80f), vec3(0.96f, 0.55f, 0.42f),
                                       vec3(0.70f, 0.08f, 0.10f)};
  return blend(kColours, 0.5f + 0.5f * strain / kMostStrain);
}

// Limbs have a hue each, the left one's lighter than the right one's, and paler towards hand and foot.
vec3 regionColour(BodyRegion region) {
  static constexpr std::array<vec3, kRegionNames.size()> kColours{
      vec3(0.86f, 0.55f, 0.10f), vec3(0.95f, 0.80f, 0.20f), vec3(0.80f, 0.25f, 0.25f),
      vec3(0.55f, 0.30f, 0.65f), vec3(0.85f, 0.40f, 0.62f), vec3(0.20f, 0.62f, 0.35f),
      vec3(0.42f, 0.78f, 0.48f), vec3(0.68f, 0.90f, 0.62f), vec3(0.08f, 0.42f, 0.30f),
      vec3(0.22f, 0.56f, 0.46f), vec3(0.46f, 0.72f, 0.64f), vec3(0.25f, 0.55f, 0.90f),
      vec3(0.45f, 0.72f, 0.96f), vec3(0.70f, 0.86f, 0.98f), vec3(0.14f, 0.30f, 0.66f),
      vec3(0.30f, 0.46f, 0.78f), vec3(0.52f, 0.64f, 0.88f), vec3(0.55f, 0.55f, 0.58f)};
  return kColours[std::size_t(region)];
}

std::vector<float> spanStrains(const Network& network, std::span<const vec4> points) {
  std::vector<float> strains = spanLengths(network, points);
  const std::vector<float> rest = spanLengths(network, network.points());
  for (std::size_t s = 0; s < strains.size(); ++s) strains[s] = rest[s] > 0 ? strains[s] / rest[s] - 1 : 0;
  return strains;
}

std::vector<LegendEntry> legendOf(const Document& document, Colouring colouring) {
  if (colouring == Colouring::kind) return kindsOf(document);
  if (colouring == Colouring::region) return regionsOf(document);
  std::vector<LegendEntry> entries;
  if (colouring == Colouring::radius)
    for (const float mm : {0.1f, 0.3f, 1.0f, 3.0f, 10.0f})
      entries.push_back({radiusColour(1e-3f * mm), fmt::format("{:g}", mm)});
  else
    for (const int percent : {-30, -15, 0, 15, 30})
      entries.push_back(
          {strainColour(0.01f * float(percent)), percent == 0 ? "0 %" : fmt::format("{:+d} %", percent)});
  return entries;
}

const std::vector<std::uint32_t>& SpanColours::of(const Document& document,
                                                  std::shared_ptr<const PosedBody> body,
                                                  Colouring colouring) {
  if (body_ == body && colouring_ == colouring) return colours_;
  body_ = std::move(body);
  colouring_ = colouring;
  colours_.clear();
  const Network& network = document.scene.network;
  const std::vector<float> strains =
      colouring == Colouring::strain ? spanStrains(network, body_->points) : std::vector<float>{};
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const auto points = Network::pointsOf(vessel, body_->points);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      vec4 colour = colourOf(vessel.kind);
      if (colouring == Colouring::region) colour = vec4(regionColour(document.groups->region[v]), 1);
      if (colouring == Colouring::radius)
        colour = vec4(radiusColour(evaluate(points, float(span) + 0.5f).w), 1);
      if (colouring == Colouring::strain) colour = vec4(strainColour(strains[colours_.size()]), 1);
      colours_.push_back(packColour(colour));
    }
  }
  return colours_;
}

}  // namespace vasa::viewer
