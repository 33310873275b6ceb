#include "plate/vessel_colours.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include "render/look.h"

namespace vasa::plate {
namespace {

constexpr float kThinnest = 0.25e-3f, kWidest = 16e-3f;  // [m] ends of the scale of radii

bool hasWord(std::string_view name, std::string_view word) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::search(name.begin(), name.end(), word.begin(), word.end(), same) != name.end();
}

// Vessels of the lungs' own circulation, by their names.
std::vector<char> ofLungs(const Network& network) {
  std::vector<char> marked;
  for (const Vessel& vessel : network.vessels()) marked.push_back(hasWord(vessel.name, "pulmonary"));
  return marked;
}

VesselKind kindByBlood(VesselKind kind, bool lung) {
  if (!lung) return kind;
  return kind == VesselKind::artery ? VesselKind::vein : kind == VesselKind::vein ? VesselKind::artery : kind;
}

struct PartColour {
  vec3 colour;
  const char* text;
};

// Muted, of like lightness, told apart also where red and green are not.
PartColour partColour(BodyPart part) {
  switch (part) {
    case BodyPart::head:
    case BodyPart::neck:
      return {{0.80f, 0.33f, 0.26f}, "Head and neck"};
    case BodyPart::thorax:
      return {{0.86f, 0.62f, 0.14f}, "Thorax"};
    case BodyPart::abdomen:
      return {{0.29f, 0.56f, 0.33f}, "Abdomen and pelvis"};
    case BodyPart::shoulder:
    case BodyPart::upperArm:
    case BodyPart::lowerArm:
    case BodyPart::hand:
      return {{0.16f, 0.50f, 0.68f}, "Arm"};
    case BodyPart::upperLeg:
    case BodyPart::lowerLeg:
    case BodyPart::foot:
      return {{0.48f, 0.31f, 0.62f}, "Leg"};
    case BodyPart::other:
      break;
  }
  return {{0.5f, 0.5f, 0.5f}, "Elsewhere"};
}

const char* bloodText(VesselKind kind) {
  switch (kind) {
    case VesselKind::artery:
      return "Blood rich in oxygen";
    case VesselKind::vein:
      return "Blood poor in oxygen";
    case VesselKind::portalVein:
      return "Portal blood";
    case VesselKind::lymphatic:
      return "Lymph";
    case VesselKind::other:
      break;
  }
  return "Not known";
}

const char* kindText(VesselKind kind) {
  switch (kind) {
    case VesselKind::artery:
      return "Arteries";
    case VesselKind::vein:
      return "Veins";
    case VesselKind::portalVein:
      return "Portal veins";
    case VesselKind::lymphatic:
      return "Lymph vessels";
    case VesselKind::other:
      break;
  }
  return "Other vessels";
}

// Colours of spans, and keys in the order of their ranks.
class Palette {
 public:
  void add(vec3 colour, bool shown) { spans_.push_back(packColour(vec4(colour, shown ? 1 : 0))); }
  void key(int rank, vec3 colour, const char* text) { keys_.try_emplace(rank, ColourKey{colour, text}); }

  VesselColours take() {
    VesselColours colours{std::move(spans_), {}, false};
    for (auto& [rank, key] : keys_)
      if (std::ranges::find(colours.keys, key.text, &ColourKey::text) == colours.keys.end())
        colours.keys.push_back(std::move(key));
    return colours;
  }

 private:
  std::vector<std::uint32_t> spans_;
  std::map<int, ColourKey> keys_;
};

}  // namespace

std::optional<VesselColouring> colouringNamed(std::string_view name) {
  constexpr std::array<std::string_view, 4> names{"kind", "blood", "region", "radius"};
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return VesselColouring(found - names.begin());
}

vec3 radiusColour(float radius) {
  static constexpr std::array kScale{vec3(0.62f, 0.79f, 0.84f), vec3(0.25f, 0.56f, 0.71f),
                                     vec3(0.25f, 0.29f, 0.56f), vec3(0.30f, 0.08f, 0.30f)};
  const float share = std::log(radius / kThinnest) / std::log(kWidest / kThinnest);
  const float at = std::clamp(share, 0.0f, 1.0f) * float(kScale.size() - 1);
  const auto first = std::min(std::size_t(at), kScale.size() - 2);
  return glm::mix(kScale[first], kScale[first + 1], at - float(first));
}

Result<VesselColours> colourVessels(const Scene& scene, VesselColouring colouring,
                                    std::span<const char> shown, std::span<const char> keyed) {
  const Network& network = scene.network;
  Palette palette;
  std::vector<SidedPart> parts;
  std::vector<Station> stations;
  if (colouring == VesselColouring::region) {
    auto known = partsOfJoints(scene.body);
    if (!known) return known.error();
    parts = std::move(*known);
    stations = mainStations(scene.binding);
  }
  const std::vector<char> lungs = ofLungs(network);
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const auto points = network.pointsOf(vessel);
    const VesselKind blood = kindByBlood(vessel.kind, lungs[v]);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      const bool visible = shown[v] != 0, inKeys = keyed[v] != 0;
      switch (colouring) {
        case VesselColouring::kind:
          palette.add(vec3(colourOf(vessel.kind)), visible);
          if (inKeys) palette.key(int(vessel.kind), vec3(colourOf(vessel.kind)), kindText(vessel.kind));
          break;
        case VesselColouring::blood:
          palette.add(vec3(colourOf(blood)), visible);
          if (inKeys) palette.key(int(blood), vec3(colourOf(blood)), bloodText(blood));
          break;
        case VesselColouring::region: {
          const BodyPart part = parts[stations[vessel.firstPoint + span + 1].joint.value].part;
          palette.add(partColour(part).colour, visible);
          if (inKeys) palette.key(int(part), partColour(part).colour, partColour(part).text);
          break;
        }
        case VesselColouring::radius:
          palette.add(radiusColour(0.5f * (points[span + 1].w + points[span + 2].w)), visible);
          break;
      }
    }
  }
  VesselColours colours = palette.take();
  if (colouring == VesselColouring::radius) {
    colours.scale = true;
    for (const float millimetres : {0.25f, 1.0f, 4.0f, 16.0f})
      colours.keys.push_back(
          {radiusColour(1e-3f * millimetres), millimetres < 1 ? "0.25" : std::to_string(int(millimetres))});
    colours.keys.back().text += " mm";
  }
  return colours;
}

}  // namespace vasa::plate
