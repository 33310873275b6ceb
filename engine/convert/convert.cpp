#include "convert/convert.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>

#include "convert/hollow.h"
#include "convert/strokes.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "core/parallel.h"

namespace vasa {
namespace {

std::vector<ElementSkeleton> skeletons(std::span<const SourceElement> elements,
                                       std::span<const std::optional<std::uint32_t>> duplicateOf,
                                       const ConvertOptions& options) {
  std::vector<ElementSkeleton> result(elements.size());
  ProgressLine progress("converting");
  std::atomic<std::size_t> done{0};
  parallelFor(elements.size(), 1, [&](std::size_t e) {
    if (!duplicateOf[e]) result[e] = skeletonise(elements[e].element.mesh, options.element);
    const std::size_t now = ++done;
    progress.update(now, elements.size());
    if (options.progress) options.progress(now, elements.size());
  });
  return result;
}

// A body is taller than wide and deep; what lies across is judged like what stands.
float heightOf(std::span<const SourceElement> elements) {
  Aabb box;
  for (const SourceElement& source : elements)
    if (!source.element.mesh.empty()) box.add(source.element.mesh.bounds());
  if (box.empty()) return 0;
  const vec3 extent = box.extent();
  return std::max({extent.x, extent.y, extent.z});
}

std::string millimetresText(float metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", 1000 * double(metres));
  return text.data();
}

struct Lumina {
  std::vector<SourceElement> elements;  // empty where all are as they were
  std::vector<std::string> walls;       // those that are not among them
};

// With every hollow wall by its lumen alone, and without walls that are elements of their own.
Lumina byLumen(std::span<const SourceElement> elements, float weldTolerance) {
  std::vector<std::optional<TriangleMesh>> lumina(elements.size());
  parallelFor(elements.size(), 1,
              [&](std::size_t e) { lumina[e] = withoutOuterWalls(elements[e].element.mesh, weldTolerance); });
  const std::vector<bool> walls = outerWalls(elements);
  Lumina all;
  if (std::ranges::none_of(lumina, [](const auto& lumen) { return lumen.has_value(); }) &&
      std::ranges::count(walls, true) == 0)
    return all;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (walls[e]) {
      all.walls.push_back(elements[e].element.name);
      continue;
    }
    all.elements.push_back(elements[e]);
    if (lumina[e])
      all.elements.back().element.mesh = std::move(*lumina[e]), all.elements.back().byLumen = true;
  }
  return all;
}

constexpr const char* kMergeFirst = "merge the vertices of triangles that belong side by side first";

// A tube's wall hangs together, even where it is holed: one or two triangles a piece are what is left where
// it does not.
bool isTorn(const ElementSkeleton& found) { return found.triangles < 3 * found.componentsTotal; }

void tellTorn(std::span<const ElementSkeleton> found) {
  std::size_t torn = 0, triangles = 0, pieces = 0;
  for (const ElementSkeleton& own : found)
    if (isTorn(own)) ++torn, triangles += own.triangles, pieces += own.componentsTotal;
  if (torn > 0)
    logWarning(std::to_string(torn) + " of " + std::to_string(found.size()) +
               " surfaces are torn: " + std::to_string(triangles) + " triangles in " +
               std::to_string(pieces) + " pieces, most of which are left out; " + kMergeFirst);
}

Error nothingFound(std::span<const SourceElement> elements, std::span<const ElementSkeleton> found,
                   std::span<const ElementOutcome> outcomes) {
  std::string why = "no element holds a tube";
  bool torn = false;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (!outcomes[e].reason.empty()) {
      why = "'" + elements[e].element.name + "': " + outcomes[e].reason;
      torn = isTorn(found[e]);
      break;
    }
  return badInput("no vessel could be made of the input (" + why + "); " +
                  (torn ? std::string("its surface is torn: ") + kMergeFirst
                        : "give surfaces of tubes as triangles, and their unit with vasa convert --unit"));
}

}  // namespace

Result<Conversion> convertElements(std::span<const SourceElement> given, const ConvertOptions& options) {
  Lumina lumina = byLumen(given, options.element.weldTolerance);
  const std::span<const SourceElement> elements =
      lumina.elements.empty() ? given : std::span<const SourceElement>(lumina.elements);
  if (!lumina.walls.empty())
    logInfo(std::to_string(lumina.walls.size()) +
            " elements are the outside of others' walls, and left out: '" + lumina.walls.front() + "' first");
  if (const auto first = std::ranges::find(elements, true, &SourceElement::byLumen); first != elements.end())
    logInfo(std::to_string(std::ranges::count(elements, true, &SourceElement::byLumen)) +
            " elements are walls with an inside and an outside, which is left out: '" + first->element.name +
            "' first");
  const auto duplicateOf = findDuplicates(elements, options.duplicates);
  const std::vector<ElementSkeleton> found = skeletons(elements, duplicateOf, options);

  StrandGraph graph;
  std::vector<ElementOutcome> outcomes(elements.size());
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    checkpoint();
    outcomes[e] = {found[e].method, found[e].reason, {}};
    if (duplicateOf[e]) outcomes[e].standIn.push_back(*duplicateOf[e]);
    pruneSlivers(graph, addSkeleton(graph, found[e], e, elements[e].kind), options.slivers);
  }
  if (graph.strands.empty()) return nothingFound(elements, found, outcomes);
  tellTorn(found);
  const float bodyHeight = options.bodyHeight > 0 ? options.bodyHeight : heightOf(elements);
  for (const Absorbed& absorbed : removeOverlaps(graph, options.overlaps))
    if (auto& standIn = outcomes[absorbed.element].standIn;
        std::ranges::find(standIn, absorbed.into) == standIn.end())
      standIn.push_back(absorbed.into);
  const AttachReport joins = attachEnds(graph, elements, bodyHeight, options.attach);
  for (std::uint32_t strand = 0; strand < graph.strands.size(); ++strand)
    for (const bool last : {false, true})
      if (!graph.strands[strand].dropped() && graph.isFree({strand, last}))
        trimTaper(graph.strands[strand].sections, last);
  graph.removeFolds();

  auto assembly = assembleNetwork(std::move(graph), elements, options.fit, bodyHeight);
  if (!assembly)
    return badInput("the vessels that were found make no network (" + assembly.error().message +
                    "); if they are not " + millimetresText(heightOf(elements)) +
                    " mm large, give their unit (--unit, --scale); if surfaces are torn or run through "
                    "themselves, mend them, or give centre lines");
  if (options.mend) {
    auto mended = options.mend(assembly->network);
    if (!mended) return mended.error();
    const auto before = assembly->network.points(), after = mended->points();
    for (std::size_t e = 0; before.size() == after.size() && e < outcomes.size(); ++e)
      for (const std::uint32_t v : assembly->vesselsOf[e]) {
        const Vessel& vessel = assembly->network.vessels()[v];
        for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p)
          outcomes[e].moved = std::max(outcomes[e].moved, glm::distance(vec3(before[p]), vec3(after[p])));
      }
    assembly->network = std::move(*mended);
  }
  std::vector<std::vector<std::uint32_t>> standIns;
  for (const ElementOutcome& outcome : outcomes) standIns.push_back(outcome.standIn);
  const auto errors = measureSurfaceErrors(*assembly, elements, standIns, options.error);
  ConvertReport report = makeReport(*assembly, elements, outcomes, errors, joins);
  return Conversion{std::move(assembly->network), std::move(report), std::move(assembly->elementOf),
                    std::move(lumina.elements), std::move(lumina.walls)};
}

}  // namespace vasa
