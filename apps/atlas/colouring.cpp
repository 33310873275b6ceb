#include "atlas/colouring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "curve/bspline.h"
#include "network/kinks.h"
#include "render/look.h"

namespace vasa::atlas {
namespace {

// A measure of spans along a ramp. Marks lie evenly on it.
struct Scale {
  const char *title, *unit;
  std::vector<float> marks;
  std::vector<vec3> ramp;
  bool logarithmic = false;
  bool sign = false;  // marks above nothing have one

  float shareOf(float value) const {
    const float low = marks.front(), high = marks.back();
    if (logarithmic) return std::log(std::max(value, 0.5f * low) / low) / std::log(high / low);
    return (value - low) / (high - low);
  }
};

// Ramps are told apart also where red and green are not; what runs both ways from a middle has grey there.
const Scale& scaleOf(Colouring colouring) {
  static const Scale radius{"Radius",
                            " mm",
                            {0.25f, 1, 4, 16},
                            {vec3(0.62f, 0.79f, 0.84f), vec3(0.25f, 0.56f, 0.71f), vec3(0.25f, 0.29f, 0.56f),
                             vec3(0.30f, 0.08f, 0.30f)},
                            true};
  static const Scale strain{"Longer or shorter than at rest",
                            " %",
                            {-30, -15, 0, 15, 30},
                            {vec3(0.07f, 0.25f, 0.65f), vec3(0.45f, 0.65f, 0.92f), vec3(0.82f, 0.82f, 0.80f),
                             vec3(0.96f, 0.55f, 0.42f), vec3(0.70f, 0.08f, 0.10f)},
                            false,
                            true};
  // At 1 the inside of a bend folds.
  static const Scale bend{"Radius by bending radius",
                          "",
                          {0, 0.25f, 0.5f, 0.75f, 1},
                          {vec3(0.80f, 0.84f, 0.86f), vec3(0.95f, 0.80f, 0.45f), vec3(0.90f, 0.50f, 0.25f),
                           vec3(0.70f, 0.20f, 0.18f), vec3(0.35f, 0.03f, 0.15f)}};
  static const Scale lumen{"Area by that at rest",
                           " %",
                           {50, 75, 100, 125, 150},
                           {vec3(0.50f, 0.05f, 0.35f), vec3(0.85f, 0.50f, 0.65f), vec3(0.82f, 0.82f, 0.80f),
                            vec3(0.45f, 0.70f, 0.65f), vec3(0.05f, 0.42f, 0.40f)}};
  switch (colouring) {
    case Colouring::strain:
      return strain;
    case Colouring::bend:
      return bend;
    case Colouring::lumen:
      return lumen;
    default:
      return radius;
  }
}

vec3 blend(std::span<const vec3> ramp, float share) {
  const float at = std::clamp(share, 0.0f, 1.0f) * float(ramp.size() - 1);
  const std::size_t first = std::min(std::size_t(at), ramp.size() - 2);
  return glm::mix(ramp[first], ramp[first + 1], at - float(first));
}

struct PartColour {
  vec3 colour;
  const char* text;
};

// Muted, of like lightness.
PartColour colourOf(BodyPart part) {
  switch (part) {
    case BodyPart::head:
    case BodyPart::neck:
      return {{0.80f, 0.33f, 0.26f}, "Head and neck"};
    case BodyPart::chest:
      return {{0.86f, 0.62f, 0.14f}, "Thorax"};
    case BodyPart::abdomen:
    case BodyPart::pelvis:
      return {{0.29f, 0.56f, 0.33f}, "Abdomen and pelvis"};
    case BodyPart::shoulder:
    case BodyPart::upperArm:
    case BodyPart::forearm:
    case BodyPart::hand:
      return {{0.16f, 0.50f, 0.68f}, "Arm"};
    case BodyPart::thigh:
    case BodyPart::leg:
    case BodyPart::foot:
      return {{0.48f, 0.31f, 0.62f}, "Leg"};
    case BodyPart::elsewhere:
      break;
  }
  return {{0.5f, 0.5f, 0.5f}, "Elsewhere"};
}

// Blood that goes to the lungs is a vein's.
VesselKind bloodOf(const Vessel& vessel, VesselSystem system) {
  if (system != VesselSystem::pulmonary) return vessel.kind;
  return vessel.kind == VesselKind::artery ? VesselKind::vein
         : vessel.kind == VesselKind::vein ? VesselKind::artery
                                           : vessel.kind;
}

const char* kindText(VesselKind kind, bool blood) {
  switch (kind) {
    case VesselKind::artery:
      return blood ? "Blood rich in oxygen" : "Arteries";
    case VesselKind::vein:
      return blood ? "Blood poor in oxygen" : "Veins";
    case VesselKind::portalVein:
      return blood ? "Portal blood" : "Portal veins";
    case VesselKind::lymphatic:
      return blood ? "Lymph" : "Lymph vessels";
    case VesselKind::other:
      break;
  }
  return blood ? "Not known" : "Other vessels";
}

// [m], by four chords.
float lengthOf(std::span<const vec4> points, std::uint32_t span) {
  constexpr int kChords = 4;
  vec3 before(evaluate(points, float(span)));
  float length = 0;
  for (int i = 1; i <= kChords; ++i) {
    const vec3 here(evaluate(points, float(span) + float(i) / kChords));
    length += glm::distance(before, here);
    before = here;
  }
  return length;
}

float strainOf(std::span<const vec4> points, std::span<const vec4> rest, std::uint32_t span) {
  const float before = lengthOf(rest, span);
  return before > 0 ? lengthOf(points, span) / before - 1 : 0;
}

// In the unit of the scale's marks.
float valueOf(Colouring colouring, std::span<const vec4> points, std::span<const vec4> rest,
              std::uint32_t span) {
  const float middle = float(span) + 0.5f, radius = evaluate(points, middle).w;
  switch (colouring) {
    case Colouring::strain:
      return 100 * strainOf(points, rest, span);
    case Colouring::bend:
      return sharpestBend(bezierOfSpan(points, span));
    case Colouring::lumen: {
      const float share = radius / evaluate(rest, middle).w;
      return 100 * share * share;
    }
    default:
      return 1e3f * radius;
  }
}

}  // namespace

std::optional<Colouring> colouringNamed(std::string_view name) {
  const auto found = std::ranges::find(kColourings, name);
  if (found == kColourings.end()) return std::nullopt;
  return Colouring(found - kColourings.begin());
}

std::string colouringsListed() {
  std::string list = kColourings.front();
  for (std::size_t c = 1; c < kColourings.size(); ++c)
    list += (c + 1 < kColourings.size() ? ", " : " or ") + std::string(kColourings[c]);
  return list;
}

Result<void> checkColouring(Colouring colouring, const VesselGroups& groups, const std::string& body) {
  if (colouring != Colouring::region || groups.person) return {};
  return badInput(
      body +
      ": its joints are not all recognised as a person's, so its regions are not known; colour by kind, "
      "blood, radius, strain, bend or lumen");
}

vec3 ColourLegend::at(float share) const { return blend(ramp, share); }

vec3 scaleColour(Colouring colouring, float value) {
  const Scale& scale = scaleOf(colouring);
  return blend(scale.ramp, scale.shareOf(value));
}

ColourLegend legendOf(const Network& network, const VesselGroups& groups, Colouring colouring,
                      std::span<const char> keyed) {
  ColourLegend legend;
  if (isScale(colouring)) {
    const Scale& scale = scaleOf(colouring);
    legend.title = scale.title;
    legend.ramp = scale.ramp;
    for (const float mark : scale.marks) {
      const char* sign = scale.sign && mark > 0 ? "+" : "";
      legend.keys.push_back({scaleColour(colouring, mark), fmt::format("{}{:g}{}", sign, mark, scale.unit)});
    }
    return legend;
  }
  std::map<int, ColourKey> found;  // in the order of kinds, or from head to foot
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    if (!keyed.empty() && !keyed[v]) continue;
    const Vessel& vessel = network.vessels()[v];
    if (colouring == Colouring::region) {
      for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p) {
        const PartColour key = colourOf(groups.ofPoint[p].part);
        found.try_emplace(int(groups.ofPoint[p].part), ColourKey{key.colour, key.text});
      }
    } else {
      const bool blood = colouring == Colouring::blood;
      const VesselKind kind = blood ? bloodOf(vessel, groups.system[v]) : vessel.kind;
      found.try_emplace(int(kind), ColourKey{vec3(vasa::colourOf(kind)), kindText(kind, blood)});
    }
  }
  for (auto& [rank, key] : found)
    if (std::ranges::find(legend.keys, key.text, &ColourKey::text) == legend.keys.end())
      legend.keys.push_back(std::move(key));
  return legend;
}

std::vector<float> spanStrains(const Network& network, std::span<const vec4> points) {
  std::vector<float> strains;
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span)
      strains.push_back(strainOf(Network::pointsOf(vessel, points), network.pointsOf(vessel), span));
  return strains;
}

std::vector<std::uint32_t> spanColours(const Network& network, const VesselGroups& groups,
                                       std::span<const vec4> points, Colouring colouring) {
  std::vector<std::uint32_t> colours;
  colours.reserve(network.sweepCount());
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const auto posed = Network::pointsOf(vessel, points), rest = network.pointsOf(vessel);
    const vec4 own =
        vasa::colourOf(colouring == Colouring::blood ? bloodOf(vessel, groups.system[v]) : vessel.kind);
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      vec4 colour = own;
      if (colouring == Colouring::region)
        colour = vec4(colourOf(groups.ofPoint[vessel.firstPoint + span + 1].part).colour, 1);
      else if (isScale(colouring))
        colour = vec4(scaleColour(colouring, valueOf(colouring, posed, rest, span)), 1);
      colours.push_back(packColour(colour));
    }
  }
  return colours;
}

void leaveOut(const Network& network, std::span<const char> shown, std::span<std::uint32_t> spanColours) {
  std::size_t first = 0;
  for (std::size_t v = 0; v < shown.size(); ++v) {
    const std::size_t count = network.vessels()[v].spanCount();
    if (!shown[v]) std::ranges::fill(spanColours.subspan(first, count), 0u);
    first += count;
  }
}

}  // namespace vasa::atlas
