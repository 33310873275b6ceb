#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "plate/body_part.h"
#include "scene/scene.h"

namespace vasa::plate {

/// What the colour of a vessel stands for: its kind by anatomy; the blood it carries, which for those of the
/// lungs is the other one; the part of the body it lies in; its radius.
enum class VesselColouring : std::uint8_t { kind, blood, region, radius };
std::optional<VesselColouring> colouringNamed(std::string_view name);

struct ColourKey {
  vec3 colour{0};  ///< sRGB
  std::string text;
};

struct VesselColours {
  std::vector<std::uint32_t> spans;  ///< packed, as Renderer::setSweepColours() takes them
  std::vector<ColourKey> keys;       ///< of the colours that are in use
  bool scale = false;                ///< the keys are marks on a scale that runs from the first to the last
};

/// @param shown  one a vessel; those with 0 are hidden
/// @param keyed  one a vessel; keys tell of the colours of these
/// Fails with badInput for `region` where the body's joints are not known (partsOfJoints).
Result<VesselColours> colourVessels(const Scene& scene, VesselColouring colouring,
                                    std::span<const char> shown, std::span<const char> keyed);

/// Between the colours of a scale of radii; @param radius  [m]
vec3 radiusColour(float radius);

}  // namespace vasa::plate
