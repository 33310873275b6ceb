#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "viewer/document.h"
#include "viewer/pose_worker.h"

namespace vasa::viewer {

/// What a vessel's colour tells.
enum class Colouring : std::uint8_t { kind, region, radius, strain };
constexpr std::array<const char*, 4> kColourings{"kind", "region", "radius", "strain"};

constexpr float kLeastRadius = 1e-4f,
                kMostRadius = 1e-2f;  ///< [m] ends of the radii's scale, which is logarithmic
constexpr float kMostStrain = 0.3f;   ///< ends of the strains' scale

/// Violet to yellow, as light rises (after matplotlib's viridis); of 0 to 1.
vec3 radiusColour(float radius);
/// Blue where a vessel is shortened, grey where it is as at rest, red where it is stretched.
vec3 strainColour(float strain);
vec3 regionColour(BodyRegion region);

/// Length of each span now by that at rest, less 1. O(spans)
std::vector<float> spanStrains(const Network& network, std::span<const vec4> points);

/// A colour of the legend and what it stands for.
struct LegendEntry {
  vec3 colour;
  std::string text;
};
/// What the colours mean: those of kinds and regions that the document has; of scales some values from one
/// end to the other.
std::vector<LegendEntry> legendOf(const Document& document, Colouring colouring);
/// Whether the legend is a scale, whose colours run into one another.
inline bool isScale(Colouring colouring) {
  return colouring == Colouring::radius || colouring == Colouring::strain;
}

/// The colours of all spans as Renderer::setSweepColours() takes them, made anew when the shape or the wish
/// is another.
class SpanColours {
 public:
  const std::vector<std::uint32_t>& of(const Document& document, std::shared_ptr<const PosedBody> body,
                                       Colouring colouring);

 private:
  std::shared_ptr<const PosedBody> body_;
  Colouring colouring_ = Colouring::kind;
  std::vector<std::uint32_t> colours_;
};

}  // namespace vasa::viewer
