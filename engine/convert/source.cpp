#include "convert/source.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "mesh/components.h"

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

namespace {

// What is drawn with one kind's materials, a part a kind. What says neither goes with what came before it.
std::vector<MeshElement> byMaterials(const MeshElement& element) {
  std::vector<MeshElement> parts;
  std::vector<VesselKind> kinds;
  std::vector<std::vector<std::uint32_t>> triangles(1);  // of each part
  std::size_t part = 0;
  std::uint32_t next = 0;
  const auto takeUpTo = [&](std::size_t end) {
    for (; next < end; ++next) triangles[part].push_back(next);
  };
  for (const MeshMaterial& material : element.materials) {
    takeUpTo(material.firstTriangle);
    const VesselKind kind = kindOf(material);
    if (kind == VesselKind::other) continue;
    part = std::size_t(std::ranges::find(kinds, kind) - kinds.begin());
    if (part < kinds.size()) continue;
    kinds.push_back(kind);
    triangles.resize(kinds.size());
    MeshElement& own = parts.emplace_back();
    own.name =
        element.name + " (" + (material.name.empty() ? std::string(kindName(kind)) : material.name) + ")";
    own.surroundings = {material.name};
    own.category = element.category, own.ontologyId = element.ontologyId;
    own.colour = material.colour;
  }
  takeUpTo(element.mesh.triangles.size());
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p].mesh = partOf(element.mesh, triangles[p]);
  return parts;
}

bool saysBoth(const MeshElement& element, std::string_view fileName) {
  const auto says = [&](VesselKind kind) {
    return std::ranges::any_of(element.materials,
                               [&](const MeshMaterial& own) { return sameFamily(kindOf(own), kind); });
  };
  return kindOfTexts(element, fileName) == VesselKind::other && says(VesselKind::artery) &&
         says(VesselKind::vein);
}

}  // namespace

std::vector<SourceElement> describeElements(std::vector<MeshElement> elements, std::string_view fileName) {
  std::vector<SourceElement> described;
  described.reserve(elements.size());
  const auto add = [&](MeshElement element) {
    const VesselKind kind = kindOf(element, fileName);
    std::string label = vesselLabel(element.name);
    described.push_back({std::move(element), kind, std::move(label)});
  };
  for (MeshElement& element : elements) {
    if (!saysBoth(element, fileName)) {
      add(std::move(element));
      continue;
    }
    for (MeshElement& part : byMaterials(element)) add(std::move(part));
  }
  return described;
}

}  // namespace vasa
