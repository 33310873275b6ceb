#include "convert/keep_patches.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "convert/joined_wall.h"
#include "convert/wall_cut.h"
#include "convert/wall_thin.h"
#include "core/parallel.h"
#include "mesh/boundary.h"
#include "mesh/weld.h"
#include "surface/patch.h"

namespace vasa {
namespace {

constexpr float kInset = 0.12f;       // of the radius: the strip between ring and wall
constexpr float kWeld = 1e-5f;        // [m] as converting does
constexpr float kEased = 0.5f;        // weight from which on the wall turns into the tube
constexpr float kEaseLimit = 0.6f;    // of the radius: farther from the tube it stays as it is
constexpr int kRounds = 400;          // of relaxation
constexpr float kNear = 1.5f;         // radii: the wall beside an opening
constexpr float kAround = 1.9f;       // radii: how far from an opening walls are joined
constexpr float kCell = 0.28f;        // of the least radius, for joining walls
constexpr float kThin = 0.15f;        // of the least radius: what a joined wall may be off for having fewer triangles

// A ring of a fork, and the section beside it, nearer to the fork, where the wall is cut.
struct Ring {
  VesselId vessel;
  float parameter = 0;
  vec4 section{0};
  vec3 outward{0};
  WallOpening opening;
};

Ring ringOf(const Network& network, const shared::ForkRing& record, std::uint32_t index, float outward) {
  Ring ring{.vessel = {index}, .parameter = forkRingParameter(network, record, index), .opening = {}};
  const auto points = network.pointsOf(network.vessels()[index]);
  const auto towards = [&](float u) { return outward * unitTangent(points, u); };
  ring.section = evaluate(points, ring.parameter);
  ring.outward = towards(ring.parameter);
  const float speed = std::max(glm::length(vec3(evaluateDerivative(points, ring.parameter))), 1e-9f);
  const float inset = std::clamp(ring.parameter - outward * kInset * ring.section.w / speed, 0.0f, float(spanCount(points)));
  const vec4 inner = evaluate(points, inset);
  ring.opening = {vec3(inner), towards(inset), inner.w};
  return ring;
}

std::vector<Ring> ringsOf(const Network& network, const ForkPlan& plan, const shared::ForkRecord& fork) {
  std::vector<Ring> rings{ringOf(network, fork.a, fork.vesselA, -fork.a.turn), ringOf(network, fork.b, fork.vesselB, fork.b.turn)};
  for (std::uint32_t i = 0; i < fork.branchCount; ++i) {
    const shared::ForkBranch& branch = plan.branches[fork.firstBranch + i];
    rings.push_back(ringOf(network, branch.ring, branch.vessel, branch.ring.turn));
  }
  return rings;
}

std::vector<WallOpening> openingsOf(std::span<const Ring> rings) {
  std::vector<WallOpening> openings;
  for (const Ring& ring : rings) openings.push_back(ring.opening);
  return openings;
}

// Each vertex' share of each loop, by relaxation: neighbours count by their nearness.
std::vector<vec4> harmonicWeights(const WallPiece& wall) {
  const MeshEdges edges = buildEdges(wall.mesh);
  std::vector<vec4> weights(wall.mesh.positions.size(), vec4(0));
  std::size_t fixed = 0;
  for (std::size_t loop = 0; loop < wall.loops.size(); ++loop)
    for (std::uint32_t k = 0; k < wall.loops[loop]; ++k) weights[fixed++][int(loop)] = 1;
  for (std::size_t i = fixed; i < weights.size(); ++i)
    for (std::size_t loop = 0; loop < wall.loops.size(); ++loop) weights[i][int(loop)] = 1.0f / float(wall.loops.size());
  for (int round = 0; round < kRounds; ++round) {
    std::vector<vec4> sum(weights.size(), vec4(0));
    std::vector<float> total(weights.size());
    for (const uvec2& e : edges.vertices) {
      const float nearness = 1 / std::max(glm::distance(wall.mesh.positions[e.x], wall.mesh.positions[e.y]), 1e-9f);
      sum[e.x] += nearness * weights[e.y], total[e.x] += nearness;
      sum[e.y] += nearness * weights[e.x], total[e.y] += nearness;
    }
    for (std::size_t i = fixed; i < weights.size(); ++i) weights[i] = sum[i] / total[i];
  }
  return weights;
}

// Towards the tube's wall beside a ring. @return whether the wall was near enough
bool easeIntoTubes(std::span<const Ring> rings, std::span<const vec4> weights, WallPiece& wall) {
  std::size_t onLoops = 0, vertex = 0;
  for (const std::uint32_t count : wall.loops) onLoops += count;
  const auto level = [](const WallOpening& o, vec3 p) {
    const vec3 d = p - o.centre;
    return d - glm::dot(d, o.outward) * o.outward;
  };
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const WallOpening& o = rings[i].opening;
    for (std::uint32_t k = 0; k < wall.loops[i]; ++k, ++vertex) {
      const vec3 d = level(o, wall.mesh.positions[vertex]);
      if (glm::length(d) < 0.2f * o.radius) return false;
      wall.mesh.positions[vertex] = o.centre + o.radius * glm::normalize(d);
    }
    for (std::size_t v = onLoops; v < wall.mesh.positions.size(); ++v) {
      const float t = std::clamp((weights[v][int(i)] - kEased) / (1 - kEased), 0.0f, 1.0f);
      const vec3 d = level(o, wall.mesh.positions[v]);
      const float size = glm::length(d), off = o.radius - size;
      if (t <= 0 || size < 0.2f * o.radius) continue;
      const float limit = std::max(0.0f, 1 - std::abs(off) / (kEaseLimit * o.radius));
      wall.mesh.positions[v] += (t * t * (3 - 2 * t) * limit * off / size) * d;
    }
  }
  return true;
}

// Each loop once around its axis, without steps back.
bool runsAround(std::span<const Ring> rings, const WallPiece& wall) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const WallOpening& o = rings[i].opening;
    const std::uint32_t count = wall.loops[i];
    for (std::uint32_t k = 0; k < count; ++k) {
      const vec3 a = wall.mesh.positions[first + k] - o.centre, b = wall.mesh.positions[first + (k + 1) % count] - o.centre;
      if (glm::dot(glm::cross(a, b), o.outward) < 0) return false;
    }
    first += count;
  }
  return true;
}

std::array<std::uint8_t, ForkPatch::kMostRings> rounded(const vec4& weights) {
  std::array<std::uint8_t, ForkPatch::kMostRings> bytes{};
  int left = 255;
  std::size_t most = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    bytes[k] = std::uint8_t(std::clamp(255 * weights[int(k)], 0.0f, 255.0f));
    left -= bytes[k];
    if (weights[int(k)] > weights[int(most)]) most = k;
  }
  bytes[most] = std::uint8_t(bytes[most] + left);
  return bytes;
}

struct Kept {
  PatchOutcome outcome = PatchOutcome::apart;
  ForkPatch patch;
  bool joined = false;
};

PatchOutcome outcomeOf(WallFault fault) {
  switch (fault) {
    case WallFault::none: return PatchOutcome::kept;
    case WallFault::noWall:
    case WallFault::apart: return PatchOutcome::apart;
    case WallFault::torn: return PatchOutcome::torn;
    case WallFault::open: return PatchOutcome::open;
    case WallFault::crowded: return PatchOutcome::crowded;
  }
  return PatchOutcome::apart;
}

Kept patchOf(const Network& network, WallPiece wall, std::span<const Ring> rings) {
  Kept kept{outcomeOf(wall.fault), {}, false};
  if (kept.outcome != PatchOutcome::kept) return kept;
  const std::vector<vec4> weights = harmonicWeights(wall);
  if (!easeIntoTubes(rings, weights, wall) || !runsAround(rings, wall)) return {PatchOutcome::notRound, {}, false};
  for (std::size_t i = 0; i < rings.size(); ++i)
    kept.patch.rings.push_back({rings[i].vessel, rings[i].parameter, vec3(rings[i].section), rings[i].outward,
                                rings[i].section.w, wall.loops[i]});
  kept.patch.positions = std::move(wall.mesh.positions);
  kept.patch.triangles = std::move(wall.mesh.triangles);
  for (const vec4& w : weights) kept.patch.weights.push_back(rounded(w));
  if (!patchFault(network, kept.patch).empty()) return {PatchOutcome::torn, {}, false};
  return kept;
}

Kept cutOut(const Network& network, const TriangleMesh& surface, std::span<const Ring> rings) {
  return patchOf(network, cutWall(surface, openingsOf(rings)), rings);
}

Kept cutOutJoined(const Network& network, std::span<const LooseWall* const> walls, std::span<const Ring> rings) {
  Aabb box;
  float least = rings[0].opening.radius;
  for (const Ring& ring : rings) {
    float inside = 0;
    for (const LooseWall* wall : walls) inside += wall->inside(ring.opening.centre);
    if (inside < 0.5f) return {PatchOutcome::apart, {}, true};  // nothing to join: told before it takes time
    box.add(ring.opening.centre, kAround * ring.opening.radius);
    least = std::min(least, ring.opening.radius);
  }
  const WallPiece wall = cutWall(joinedWall(walls, box, kCell * least), openingsOf(rings));
  Kept kept{outcomeOf(wall.fault), {}, true};
  if (kept.outcome == PatchOutcome::torn) kept.outcome = PatchOutcome::open;  // its only border is the box
  if (kept.outcome != PatchOutcome::kept) return kept;
  kept = patchOf(network, thinned(wall, kThin * least), rings);
  kept.joined = true;
  return kept;
}

bool holdsAll(const Aabb& box, std::span<const Ring> rings) {
  return std::ranges::all_of(rings, [&](const Ring& ring) {
    Aabb around;
    around.add(ring.opening.centre, kNear * ring.opening.radius);
    return box.overlaps(around);
  });
}

// The elements' surfaces: with their holes closed, and as they are.
struct Surfaces {
  std::vector<TriangleMesh> meshes;
  std::vector<Aabb> boxes;
  std::vector<std::unique_ptr<LooseWall>> loose;

  explicit Surfaces(std::span<const SourceElement> elements) : meshes(elements.size()), loose(elements.size()) {
    parallelFor(elements.size(), 1, [&](std::size_t e) {
      TriangleMesh welded = weld(elements[e].element.mesh, kWeld);
      const MeshEdges edges = buildEdges(welded);
      meshes[e] = fillLoops(welded, edges, boundaryLoops(welded, edges));
      loose[e] = std::make_unique<LooseWall>(std::move(welded));
    });
    for (const TriangleMesh& mesh : meshes) boxes.push_back(mesh.bounds());
  }
};

// From a surface of its own vessels, or else from another one that holds them all (scanned parts overlap), or else from
// what its vessels' surfaces make together.
Kept keepOne(const Network& network, std::span<const SourceElement> elements, std::span<const std::uint32_t> elementOf,
             const Surfaces& surfaces, std::span<const Ring> rings) {
  std::vector<std::uint32_t> tried;
  Kept best;
  const auto attempt = [&](std::uint32_t e) {
    if (best.outcome == PatchOutcome::kept || std::ranges::find(tried, e) != tried.end()) return;
    tried.push_back(e);
    if (!holdsAll(surfaces.boxes[e], rings)) return;
    Kept kept = cutOut(network, surfaces.meshes[e], rings);
    if (best.outcome == PatchOutcome::apart || kept.outcome == PatchOutcome::kept) best = std::move(kept);
  };
  for (const Ring& ring : rings) attempt(elementOf[ring.vessel.value]);
  const VesselKind kind = network.vessel(rings[0].vessel).kind;
  for (std::uint32_t e = 0; e < elements.size(); ++e)
    if (sameFamily(elements[e].kind, kind)) attempt(e);
  if (best.outcome == PatchOutcome::kept) return best;
  std::vector<const LooseWall*> walls;
  for (const Ring& ring : rings)
    if (const LooseWall* wall = surfaces.loose[elementOf[ring.vessel.value]].get(); std::ranges::find(walls, wall) == walls.end())
      walls.push_back(wall);
  return cutOutJoined(network, walls, rings);
}

}  // namespace

std::string_view outcomeName(PatchOutcome outcome) {
  switch (outcome) {
    case PatchOutcome::kept: return "kept";
    case PatchOutcome::noMesh: return "the source is centre lines, without a wall";
    case PatchOutcome::apart: return "the walls of its vessels do not meet in the source";
    case PatchOutcome::torn: return "the wall is torn there";
    case PatchOutcome::open: return "the wall goes on between its vessels";
    case PatchOutcome::crowded: return "its vessels end too near to one another";
    case PatchOutcome::notRound: return "the wall is far from the vessels' tubes";
  }
  return "";
}

std::uint32_t PatchReport::count(PatchOutcome outcome) const {
  return std::uint32_t(std::ranges::count(forks, outcome, &Fork::outcome));
}

std::uint32_t PatchReport::joined() const {
  return std::uint32_t(std::ranges::count_if(forks, [](const Fork& f) { return f.joined && f.outcome == PatchOutcome::kept; }));
}

KeptPatches keepPatches(const Network& network, std::span<const SourceElement> elements,
                        std::span<const std::uint32_t> elementOf) {
  const ForkPlan plan = planForks(network);
  std::vector<std::vector<Ring>> forks;
  for (const shared::ForkRecord& fork : plan.forks)
    if (fork.branchCount > 0) forks.push_back(ringsOf(network, plan, fork));
  std::vector<Kept> kept(forks.size());
  if (!elements.empty()) {
    const Surfaces surfaces(elements);
    parallelFor(forks.size(), 1, [&](std::size_t i) { kept[i] = keepOne(network, elements, elementOf, surfaces, forks[i]); });
  }
  KeptPatches result;
  for (std::size_t i = 0; i < forks.size(); ++i) {
    PatchReport::Fork& fork = result.report.forks.emplace_back();
    for (const Ring& ring : forks[i]) fork.vessels.push_back(ring.vessel);
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
