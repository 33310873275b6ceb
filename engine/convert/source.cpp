#include "convert/source.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>

#include "convert/duplicates.h"
#include "convert/report.h"
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

// One a triangle: the first vertex of what it hangs together with.
std::vector<std::uint32_t> piecesOf(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.positions.size()), pieces;
  std::iota(all.begin(), all.end(), 0u);
  DisjointSets sets = joinedVertices(mesh, std::move(all));
  for (const uvec3& t : mesh.triangles) pieces.push_back(sets.find(t.x));
  return pieces;
}

// What is drawn with one kind's materials, a part a kind. What says neither goes with what it hangs together
// with, where that is of both kinds with what came before it; else it is a part of its own (organs among
// vessels).
std::vector<MeshElement> byMaterials(const MeshElement& element) {
  std::vector<MeshElement> parts;
  std::vector<VesselKind> kinds;
  std::vector<std::vector<std::uint32_t>> triangles;
  const auto isNamed = [&](const std::string& name) {
    return std::ranges::find(parts, name, &MeshElement::name) != parts.end();
  };
  const auto partFor = [&](VesselKind kind, const MeshMaterial& material) {
    const auto part = std::size_t(std::ranges::find(kinds, kind) - kinds.begin());
    if (part < kinds.size()) return part;
    std::string name = element.name + " (" + material.name + ")";
    if (material.name.empty() || isNamed(name))
      name = element.name + " (" + std::string(kindName(kind)) + ")";
    kinds.push_back(kind);
    triangles.emplace_back();
    MeshElement& own = parts.emplace_back();
    own.name = std::move(name);
    own.surroundings = {material.name};
    own.category = element.category, own.ontologyId = element.ontologyId;
    own.colour = material.colour;
    return part;
  };
  const std::vector<std::uint32_t> pieces = piecesOf(element.mesh);
  const auto eachRun = [&](const auto& take) {
    if (const std::uint32_t first = element.materials[0].firstTriangle; first > 0)
      take(MeshMaterial{}, 0u, first);
    for (std::size_t m = 0; m < element.materials.size(); ++m) {
      const bool last = m + 1 == element.materials.size();
      take(element.materials[m], element.materials[m].firstTriangle,
           last ? std::uint32_t(pieces.size()) : element.materials[m + 1].firstTriangle);
    }
  };
  constexpr std::size_t kUntold = ~std::size_t(0), kBoth = kUntold - 1;
  std::vector<std::size_t> partOfPiece(element.mesh.positions.size(), kUntold);
  std::size_t before = kUntold;  // the first part of a kind, until one has come
  eachRun([&](const MeshMaterial& material, std::uint32_t first, std::uint32_t end) {
    const VesselKind kind = kindOf(material);
    if (kind == VesselKind::other) return;
    const std::size_t part = partFor(kind, material);
    before = std::min(before, part);
    for (std::uint32_t t = first; t < end; ++t) {
      std::size_t& told = partOfPiece[pieces[t]];
      told = told == kUntold || told == part ? part : kBoth;
    }
  });
  eachRun([&](const MeshMaterial& material, std::uint32_t first, std::uint32_t end) {
    const VesselKind kind = kindOf(material);
    if (kind != VesselKind::other) before = partFor(kind, material);
    for (std::uint32_t t = first; t < end; ++t) {
      const std::size_t told = kind == VesselKind::other ? partOfPiece[pieces[t]] : before;
      const std::size_t part = told == kUntold ? partFor(kind, material) : told == kBoth ? before : told;
      triangles[part].push_back(t);
    }
  });
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
    const NoVessel noVessel = namesNoVessel(element, fileName);
    described.push_back({std::move(element), kind, std::move(label), false, noVessel});
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

std::vector<NoVessel> noVessels(const std::vector<SourceElement>& sources) {
  std::vector<char> wide;
  for (const SourceElement& source : sources)
    wide.push_back(roughRadius(source.element.mesh) > kWidestVessel);
  // The skin of a body, say, which holds most of what is named as a vessel (an aneurysm holds none). Where
  // that is as wide, all are in another unit.
  std::vector<vec3> named;
  for (std::size_t e = 0; e < sources.size(); ++e)
    if (sources[e].kind != VesselKind::other && sources[e].noVessel == NoVessel::none && !wide[e])
      named.push_back(sources[e].element.mesh.bounds().centre());
  const auto holdsMost = [&](const SourceElement& source) {
    const Aabb box = source.element.mesh.bounds();
    const auto inside = std::ranges::count_if(named, [&](vec3 place) { return box.distance(place) == 0; });
    return 2 * std::size_t(inside) > named.size();
  };
  std::vector<NoVessel> why;
  for (std::size_t e = 0; e < sources.size(); ++e) {
    const SourceElement& source = sources[e];
    why.push_back(source.noVessel);
    if (why[e] == NoVessel::none && source.kind == VesselKind::other && !named.empty() && wide[e] &&
        holdsMost(source))
      why[e] = NoVessel::width;
  }
  if (std::ranges::count(why, NoVessel::none) == 0) why.assign(why.size(), NoVessel::none);
  return why;
}

std::vector<LeftOut> leaveOutNoVessels(std::vector<SourceElement>& sources) {
  std::vector<LeftOut> left;
  std::vector<SourceElement> stay;
  const std::vector<NoVessel> why = noVessels(sources);
  for (std::size_t e = 0; e < sources.size(); ++e)
    if (why[e] == NoVessel::none)
      stay.push_back(std::move(sources[e]));
    else
      left.push_back({std::move(sources[e].element.name), why[e]});
  sources = std::move(stay);
  return left;
}

}  // namespace vasa
