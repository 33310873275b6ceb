#include "convert/source.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace vasa {
std::string vesselLabel(std::string_view name) {
  const std::size_t space = name.find(' ');
  if (space == name.npos) return std::string(name);
  const std::string_view word = name.substr(0, space);
  const auto letter = [](unsigned char c) { return std::isupper(c) != 0; };
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto numberAt = std::ranges::find_if_not(word, letter);
  const auto suffixAt = std::find_if_not(numberAt, word.end(), digit);
  const bool catalogued =
      numberAt != word.begin() && suffixAt - numberAt >= 3 && std::all_of(suffixAt, word.end(), letter);
  const std::size_t start = name.find_first_not_of(' ', space);
  return std::string(catalogued && start != name.npos ? name.substr(start) : name);
}

bool sameFamily(VesselKind a, VesselKind b) {
  const auto family = [](VesselKind kind) {
    return kind == VesselKind::portalVein ? VesselKind::vein : kind;
  };
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
