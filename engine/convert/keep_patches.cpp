#include "convert/keep_patches.h"

#include <algorithm>
#include <memory>

#include "convert/fork_openings.h"
#include "convert/joined_wall.h"
#include "convert/patch_fit.h"
#include "convert/wall_sides.h"
#include "convert/wall_thin.h"
#include "core/parallel.h"
#include "mesh/boundary.h"
#include "mesh/weld.h"
#include "surface/patch.h"

namespace vasa {
namespace {

constexpr float kWeld = 1e-5f;   // [m] as converting does
constexpr float kNear = 1.5f;    // radii: the wall beside an opening
constexpr float kAround = 2.3f;  // radii: how far from an opening walls are joined
constexpr float kCell = 0.28f;   // of the least radius, for joining walls
// Of the least radius: what a joined wall may be off for having fewer triangles.
constexpr float kThin = 0.15f;
constexpr float kAxisStep = 0.25f;  // spans
// Of the least radius: farther from the source a wall is not the source's.
constexpr float kOff = 0.3f;
constexpr float kMostMade = 0.25f;  // of the wall's area may be that,
constexpr float kLongestGap = 2;    // and as much of it as a tube of the least radius has, in radii
// Radii: openings move out, where the wall between them cannot be cut out.
constexpr float kFurther = 0.5f;

struct Kept {
  PatchOutcome outcome = PatchOutcome::apart;
  ForkPatch patch;
  bool joined = false;
};

PatchOutcome outcomeOf(WallFault fault) {
  switch (fault) {
    case WallFault::none:
      return PatchOutcome::kept;
    case WallFault::noWall:
    case WallFault::apart:
      return PatchOutcome::apart;
    case WallFault::torn:
      return PatchOutcome::torn;
    case WallFault::open:
      return PatchOutcome::open;
    case WallFault::crowded:
      return PatchOutcome::crowded;
  }
  return PatchOutcome::apart;
}

std::vector<WallOpening> cutsOf(std::span<const ForkOpening> openings) {
  std::vector<WallOpening> cuts;
  for (const ForkOpening& opening : openings) cuts.push_back(opening.cut);
  return cuts;
}

Kept patchOf(const Network& network, WallPiece wall, std::span<const ForkOpening> openings) {
  Kept kept{outcomeOf(wall.fault), {}, false};
  if (kept.outcome != PatchOutcome::kept) return kept;
  kept.patch = fitPatch(openings, std::move(wall));
  if (kept.patch.rings.empty()) return {PatchOutcome::notRound, {}, false};
  if (!patchFault(network, kept.patch).empty()) return {PatchOutcome::torn, {}, false};
  return kept;
}

Kept cutOut(const Network& network, const TriangleMesh& surface, std::span<const ForkOpening> openings) {
  return patchOf(network, cutWall(surface, cutsOf(openings)), openings);
}

// Whether most of it is the source's: what is not closes gaps of a radius or two.
bool isSources(const TriangleMesh& mesh, std::span<const LooseWall* const> walls, float least) {
  const float off = kOff * least;
  float made = 0, all = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const float area = glm::length(glm::cross(b - a, c - a)) / 2;
    const vec3 middle = (a + b + c) / 3.0f;
    all += area;
    if (std::ranges::none_of(walls, [&](const LooseWall* wall) { return wall->distance(middle, off) < off; }))
      made += area;
  }
  return made < kMostMade * all && made < kLongestGap * 2 * kPi * least * least;
}

Kept cutOutJoined(const Network& network, std::span<const LooseWall* const> walls,
                  std::span<const ForkOpening> openings) {
  Aabb box;
  float least = openings[0].cut.radius;
  for (const ForkOpening& opening : openings) {
    box.add(opening.cut.centre, kAround * opening.cut.radius);
    least = std::min(least, opening.cut.radius);
  }
  const std::vector<Capsule> cores = forkCores(network, openings);
  const WallPiece wall = cutWall(joinedWall(walls, cores, box, kCell * least), cutsOf(openings));
  Kept kept{outcomeOf(wall.fault), {}, true};
  if (kept.outcome == PatchOutcome::torn) kept.outcome = PatchOutcome::open;  // its only border is the box
  if (kept.outcome != PatchOutcome::kept) return kept;
  const WallPiece thin = thinned(wall, kThin * least);
  if (!isSources(thin.mesh, walls, least)) return {PatchOutcome::apart, {}, true};
  kept = patchOf(network, thin, openings);
  kept.joined = true;
  return kept;
}

bool holdsAll(const Aabb& box, std::span<const ForkOpening> openings) {
  return std::ranges::all_of(openings, [&](const ForkOpening& opening) {
    Aabb around;
    around.add(opening.cut.centre, kNear * opening.cut.radius);
    return box.overlaps(around);
  });
}

// Places on the axes of the vessels that an element became.
std::vector<vec3> axesOf(const Network& network, std::span<const std::uint32_t> elementOf,
                         std::uint32_t element) {
  std::vector<vec3> axes;
  for (std::uint32_t v = 0; v < elementOf.size(); ++v) {
    if (elementOf[v] != element) continue;
    const auto points = network.pointsOf(network.vessels()[v]);
    for (float u = 0; u <= float(spanCount(points)); u += kAxisStep) axes.emplace_back(evaluate(points, u));
  }
  return axes;
}

// The elements' surfaces: with their holes closed, and as they are.
struct Surfaces {
  std::vector<TriangleMesh> meshes;
  std::vector<Aabb> boxes;
  std::vector<std::unique_ptr<LooseWall>> loose;

  Surfaces(const Network& network, std::span<const SourceElement> elements,
           std::span<const std::uint32_t> elementOf)
      : meshes(elements.size()), loose(elements.size()) {
    parallelFor(elements.size(), 1, [&](std::size_t e) {
      TriangleMesh welded = weld(elements[e].element.mesh, kWeld);
      const MeshEdges edges = buildEdges(welded);
      meshes[e] = fillLoops(welded, edges, boundaryLoops(welded, edges));
      if (const std::vector<vec3> axes = axesOf(network, elementOf, std::uint32_t(e)); !axes.empty())
        turnOutward(welded, axes);
      loose[e] = std::make_unique<LooseWall>(std::move(welded));
    });
    for (const TriangleMesh& mesh : meshes) boxes.push_back(mesh.bounds());
  }
};

struct Keeper {
  const Network& network;
  std::span<const SourceElement> elements;
  std::span<const std::uint32_t> elementOf;
  const Surfaces& surfaces;

  // From a surface of its own vessels, or else from another one that holds them all (scanned parts overlap).
  Kept fromOne(std::span<const ForkOpening> openings) const {
    std::vector<std::uint32_t> tried;
    Kept best;
    const auto attempt = [&](std::uint32_t e) {
      if (best.outcome == PatchOutcome::kept || std::ranges::find(tried, e) != tried.end()) return;
      tried.push_back(e);
      if (!holdsAll(surfaces.boxes[e], openings)) return;
      Kept kept = cutOut(network, surfaces.meshes[e], openings);
      if (best.outcome == PatchOutcome::apart || kept.outcome == PatchOutcome::kept) best = std::move(kept);
    };
    for (const ForkOpening& opening : openings) attempt(elementOf[opening.vessel.value]);
    const VesselKind kind = network.vessel(openings[0].vessel).kind;
    for (std::uint32_t e = 0; e < elements.size(); ++e)
      if (sameFamily(elements[e].kind, kind)) attempt(e);
    return best;
  }

  std::vector<const LooseWall*> wallsOf(std::span<const ForkOpening> openings) const {
    std::vector<const LooseWall*> walls;
    for (const ForkOpening& opening : openings)
      if (const LooseWall* wall = surfaces.loose[elementOf[opening.vessel.value]].get();
          std::ranges::find(walls, wall) == walls.end())
        walls.push_back(wall);
    return walls;
  }

  // From one surface, or else from what its vessels' surfaces make together: behind where these part, further
  // out, and where it was planned.
  Kept keep(const std::vector<ForkOpening>& planned) const {
    const std::vector<const LooseWall*> walls = wallsOf(planned);
    std::vector<ForkOpening> openings = planned;
    moveBeyondUnion(network, walls, openings);
    const bool moved =
        !std::ranges::equal(openings, planned, {}, &ForkOpening::parameter, &ForkOpening::parameter);
    Kept kept = fromOne(openings);
    if (kept.outcome == PatchOutcome::kept) return kept;
    kept = cutOutJoined(network, walls, openings);
    if (kept.outcome == PatchOutcome::open || kept.outcome == PatchOutcome::crowded) {
      for (ForkOpening& opening : openings)
        opening = movedOut(network, opening, kFurther * opening.section.w);
      kept = cutOutJoined(network, walls, openings);
    }
    return kept.outcome == PatchOutcome::kept || !moved ? kept : cutOutJoined(network, walls, planned);
  }
};

}  // namespace

std::string_view outcomeName(PatchOutcome outcome) {
  switch (outcome) {
    case PatchOutcome::kept:
      return "kept";
    case PatchOutcome::noMesh:
      return "the source is centre lines, without a wall";
    case PatchOutcome::apart:
      return "the walls of its vessels do not meet in the source";
    case PatchOutcome::torn:
      return "the wall is torn there";
    case PatchOutcome::open:
      return "the wall goes on between its vessels";
    case PatchOutcome::crowded:
      return "its vessels end too near to one another";
    case PatchOutcome::notRound:
      return "the wall is far from the vessels' tubes";
  }
  return "";
}

std::uint32_t PatchReport::count(PatchOutcome outcome) const {
  return std::uint32_t(std::ranges::count(forks, outcome, &Fork::outcome));
}

std::uint32_t PatchReport::joined() const {
  return std::uint32_t(std::ranges::count_if(
      forks, [](const Fork& f) { return f.joined && f.outcome == PatchOutcome::kept; }));
}

KeptPatches keepPatches(const Network& network, std::span<const SourceElement> elements,
                        std::span<const std::uint32_t> elementOf) {
  const ForkPlan plan = planForks(network);
  std::vector<std::vector<ForkOpening>> forks;
  for (const shared::ForkRecord& fork : plan.forks)
    if (fork.branchCount > 0) forks.push_back(forkOpenings(network, plan, fork));
  std::vector<Kept> kept(forks.size());
  if (!elements.empty()) {
    const Surfaces surfaces(network, elements, elementOf);
    const Keeper keeper{network, elements, elementOf, surfaces};
    parallelFor(forks.size(), 1, [&](std::size_t i) { kept[i] = keeper.keep(forks[i]); });
  }
  KeptPatches result;
  for (std::size_t i = 0; i < forks.size(); ++i) {
    PatchReport::Fork& fork = result.report.forks.emplace_back();
    for (const ForkOpening& opening : forks[i]) fork.vessels.push_back(opening.vessel);
    fork.outcome = elements.empty() ? PatchOutcome::noMesh : kept[i].outcome;
    fork.joined = kept[i].joined;
    if (fork.outcome != PatchOutcome::kept) continue;
    fork.triangles = std::uint32_t(kept[i].patch.triangles.size());
    result.report.vertices += std::uint32_t(kept[i].patch.positions.size());
    result.report.triangles += fork.triangles;
    result.patches.push_back(std::move(kept[i].patch));
  }
  return result;
}

}  // namespace vasa
