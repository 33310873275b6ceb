#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "atlas/vessel_groups.h"

namespace vasa::atlas {

/// What a vessel's colour tells: its kind by anatomy; the blood it carries, which for vessels of the lungs is
/// the other one; the part of the body it lies in; and span by span its radius, its length by that at rest,
/// how sharply it bends, the area of its lumen by that at rest.
enum class Colouring : std::uint8_t { kind, blood, region, radius, strain, bend, lumen };
constexpr std::array<const char*, 7> kColourings{"kind",   "blood", "region", "radius",
                                                 "strain", "bend",  "lumen"};
std::optional<Colouring> colouringNamed(std::string_view name);
/// The names as a help text lists them: "kind, blood, ... or lumen".
std::string colouringsListed();

/// Whether colours run into one another along a scale; they follow the pose.
constexpr bool isScale(Colouring colouring) { return colouring >= Colouring::radius; }

/// Fails with badInput for region where the body's is not known to be a person's.
Result<void> checkColouring(Colouring colouring, const VesselGroups& groups, const std::string& body);

struct ColourKey {
  vec3 colour{0};  ///< sRGB
  std::string text;
};

/// What colours mean: those that are in use, or evenly spaced marks of a scale.
struct ColourLegend {
  std::string title;  ///< what a scale measures; empty: no scale
  std::vector<ColourKey> keys;
  std::vector<vec3> ramp;  ///< colours that lie evenly along a scale; empty: no scale
  /// @param share  of the scale's length, from 0 to 1
  vec3 at(float share) const;
};

/// @param keyed  one a vessel: keys tell of the colours of these; empty: of all
ColourLegend legendOf(const Network& network, const VesselGroups& groups, Colouring colouring,
                      std::span<const char> keyed = {});

/// The colour of a value on a scale (isScale()), in the unit of its marks: radius [mm], strain [%], bend
/// (radius times curvature), lumen [%].
vec3 scaleColour(Colouring colouring, float value);

/// Length of each span now by that at rest, less 1. O(spans)
std::vector<float> spanStrains(const Network& network, std::span<const vec4> points);

/// The colours of all spans, packed as Renderer::setSweepColours() takes them. O(spans)
/// @param points  the network's, posed
std::vector<std::uint32_t> spanColours(const Network& network, const VesselGroups& groups,
                                       std::span<const vec4> points, Colouring colouring);

/// Vessels that are not shown have no colour, which leaves them out of the picture.
/// @param shown  one a vessel
void leaveOut(const Network& network, std::span<const char> shown, std::span<std::uint32_t> spanColours);

}  // namespace vasa::atlas
