#include "convert/source.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace vasa {
namespace {

std::string lowered(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return result;
}

template <std::size_t N>
bool hasAny(const std::string& text, const std::array<std::string_view, N>& words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != text.npos; });
}

// Veins first: "vein of the artery's wall" is rarer than "artery" inside a vein's name, but "arteriovenous"
// says neither, so a text with both is left to the next source.
VesselKind kindInText(std::string_view raw) {
  static constexpr std::array<std::string_view, 4> kArtery{"arter", "aorta", "aortic", "coeliac trunk"};
  static constexpr std::array<std::string_view, 6> kVein{"vein", "vena ", "venae", "venous", "venule", "azygos"};
  static constexpr std::array<std::string_view, 2> kLymph{"lymph", "thoracic duct"};
  const std::string text = lowered(raw) + " ";
  const bool artery = hasAny(text, kArtery), vein = hasAny(text, kVein);
  if (hasAny(text, kLymph)) return VesselKind::lymphatic;
  if (artery == vein) return VesselKind::other;
  return artery ? VesselKind::artery : VesselKind::vein;
}

}  // namespace

VesselKind kindOf(const MeshElement& element, std::string_view fileName) {
  VesselKind kind = VesselKind::other;
  for (const std::string_view text : {std::string_view(element.category), fileName, std::string_view(element.name)})
    if (kind = kindInText(text); kind != VesselKind::other) break;
  const bool portal = lowered(element.name).find("portal") != std::string::npos;
  return kind == VesselKind::vein && portal ? VesselKind::portalVein : kind;
}

std::string vesselLabel(std::string_view name) {
  const std::size_t space = name.find(' ');
  if (space == name.npos) return std::string(name);
  const std::string_view word = name.substr(0, space);
  const auto letter = [](unsigned char c) { return std::isupper(c) != 0; };
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto numberAt = std::ranges::find_if_not(word, letter);
  const auto suffixAt = std::find_if_not(numberAt, word.end(), digit);
  const bool catalogued = numberAt != word.begin() && suffixAt - numberAt >= 3 && std::all_of(suffixAt, word.end(), letter);
  const std::size_t start = name.find_first_not_of(' ', space);
  return std::string(catalogued && start != name.npos ? name.substr(start) : name);
}

bool sameFamily(VesselKind a, VesselKind b) {
  const auto family = [](VesselKind kind) { return kind == VesselKind::portalVein ? VesselKind::vein : kind; };
  return family(a) == family(b);
}

std::vector<SourceElement> describeElements(std::vector<MeshElement> elements, std::string_view fileName) {
  std::vector<SourceElement> described;
  described.reserve(elements.size());
  for (MeshElement& element : elements) {
    const VesselKind kind = kindOf(element, fileName);
    std::string label = vesselLabel(element.name);
    described.push_back({std::move(element), kind, std::move(label)});
  }
  return described;
}

}  // namespace vasa
