#include <algorithm>
#include <array>
#include <cctype>

#include "convert/source.h"

// The one place that says what names, numbers and colours mean for a vessel's kind.
namespace vasa {
namespace {

// Small letters, a space between words and around the whole: "Superior_VenaCava2" -> " superior vena cava 2
// ".
std::string spaced(std::string_view text) {
  std::string words = " ";
  char before = ' ';
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    const bool starts = (std::isupper(u) && std::islower(static_cast<unsigned char>(before))) ||
                        (std::isdigit(u) != 0) != (std::isdigit(static_cast<unsigned char>(before)) != 0);
    if (starts && words.back() != ' ') words += ' ';
    if (std::isalnum(u))
      words += char(std::tolower(u));
    else if (words.back() != ' ')
      words += ' ';
    before = c;
  }
  if (words.back() != ' ') words += ' ';
  return words;
}

template <std::size_t N>
bool hasAny(const std::string& text, const std::array<std::string_view, N>& words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != text.npos; });
}

// A text that says both ("artery beside a vein", "arteriovenous") says neither, and is left to the next
// source.
VesselKind kindInText(std::string_view raw) {
  // Arches and arcades of hand, foot and bowel are arteries where nothing says that they are venous.
  static constexpr std::array<std::string_view, 18> kArtery{"arter",
                                                            "aorta",
                                                            "aortic",
                                                            "coeliac trunk",
                                                            "celiac trunk",
                                                            "pulmonary trunk",
                                                            "truncus pulmonalis",
                                                            "brachiocephalic trunk",
                                                            "carotid",
                                                            " lad ",
                                                            " rca ",
                                                            " lcx ",
                                                            "thyrocervical",
                                                            "costocervical",
                                                            "palmar arch",
                                                            "plantar arch",
                                                            "carpal arch",
                                                            "intestinal arcade"};
  static constexpr std::array<std::string_view, 22> kVein{" vein",
                                                          " vena ",
                                                          " venae ",
                                                          " venous",
                                                          "venule",
                                                          "azygos",
                                                          "azygous",
                                                          " cava ",
                                                          " svc ",
                                                          " ivc ",
                                                          "coronary sinus",
                                                          "sagittal sinus",
                                                          "transverse sinus",
                                                          "sigmoid sinus",
                                                          "jugular",
                                                          "straight sinus",
                                                          "occipital sinus",
                                                          "cavernous sinus",
                                                          "petrosal sinus",
                                                          "confluence of sinuses",
                                                          "pterygoid plexus",
                                                          "pampiniform"};
  static constexpr std::array<std::string_view, 2> kLymph{"lymph", "thoracic duct"};
  const std::string text = spaced(raw);
  const bool artery = hasAny(text, kArtery), vein = hasAny(text, kVein);
  if (hasAny(text, kLymph)) return VesselKind::lymphatic;
  if (artery == vein) return VesselKind::other;
  return artery ? VesselKind::artery : VesselKind::vein;
}

// The great vessels, whose names do not say it in every language.
struct Known {
  std::string_view ontology, number;
  VesselKind kind;
};
constexpr std::array kKnown{
    Known{"fma", "3734", VesselKind::artery},   // aorta
    Known{"fma", "3736", VesselKind::artery},   // ascending aorta
    Known{"fma", "3768", VesselKind::artery},   // arch of aorta
    Known{"fma", "3784", VesselKind::artery},   // descending aorta
    Known{"fma", "87217", VesselKind::artery},  // descending thoracic aorta
    Known{"fma", "3789", VesselKind::artery},   // abdominal aorta
    Known{"fma", "3932", VesselKind::artery},   // brachiocephalic artery
    Known{"fma", "8612", VesselKind::artery},   // pulmonary trunk
    Known{"fma", "50873", VesselKind::artery},  // left pulmonary artery
    Known{"fma", "50872", VesselKind::artery},  // right pulmonary artery
    Known{"fma", "4720", VesselKind::vein},     // superior vena cava
    Known{"fma", "10951", VesselKind::vein},    // inferior vena cava
    Known{"fma", "4706", VesselKind::vein},     // coronary sinus
    Known{"fma", "50735", VesselKind::portalVein},  Known{"uberon", "0000947", VesselKind::artery},  // aorta
    Known{"uberon", "0002333", VesselKind::artery},  // pulmonary trunk
    Known{"uberon", "0001585", VesselKind::vein},    // superior vena cava
    Known{"uberon", "0001072", VesselKind::vein},    // inferior vena cava
    Known{"uberon", "0005438", VesselKind::vein},    // coronary sinus
};

VesselKind kindByNumber(std::string_view raw) {
  const std::string text = spaced(raw);
  for (const Known& known : kKnown)
    if (text.find(' ' + std::string(known.ontology) + ' ' + std::string(known.number) + ' ') != text.npos)
      return known.kind;
  return VesselKind::other;
}

// Red and blue as every atlas has them, if it has; pink organs and grey plaster say nothing.
VesselKind kindOfColour(vec3 c) {
  constexpr float kClear = 2;  // times as much as of either other colour
  if (c.r > 0.05f && c.r > kClear * std::max(c.g, c.b)) return VesselKind::artery;
  if (c.b > 0.05f && c.b > kClear * c.r && c.b > 1.25f * c.g) return VesselKind::vein;
  return VesselKind::other;
}

}  // namespace

VesselKind kindOf(const MeshElement& element, std::string_view fileName) {
  std::vector<std::string_view> numbered{element.ontologyId, element.name},
      texts{element.category, element.name, fileName};
  for (const std::string& name : element.surroundings) numbered.push_back(name), texts.push_back(name);
  VesselKind kind = kindInText(element.category);
  for (const std::string_view text : numbered)
    if (kind == VesselKind::other) kind = kindByNumber(text);
  for (const std::string_view text : texts)
    if (kind == VesselKind::other) kind = kindInText(text);
  if (kind == VesselKind::other && element.colour) kind = kindOfColour(*element.colour);
  if (kind != VesselKind::vein) return kind;
  const auto portal = [](std::string_view text) {
    return spaced(text).find(" portal ") != std::string::npos;
  };
  const bool told = portal(element.name) || std::ranges::any_of(element.surroundings, portal);
  return told ? VesselKind::portalVein : kind;
}

}  // namespace vasa
