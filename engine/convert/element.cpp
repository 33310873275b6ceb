#include "convert/element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "convert/bridge.h"
#include "convert/forks.h"
#include "convert/prune.h"
#include "convert/reeb.h"
#include "convert/reslice.h"
#include "convert/rings.h"
#include "convert/strand.h"
#include "convert/surface_error.h"
#include "convert/untold.h"
#include "core/cancellation.h"
#include "math/closest_point.h"
#include "mesh/boundary.h"
#include "mesh/components.h"
#include "mesh/level_set.h"
#include "mesh/weld.h"

namespace vasa {
namespace {

// Of a piece, end to end: a splinter of few triangles says no more by thousands. A straight tube of two rings
// of six, 1 m long and 3 mm wide, has 46 a triangle.
constexpr std::size_t kMostSections = 5000, kSectionsATriangle = 100;
// Sides that a tube has at the least: fewer triangles close around nothing.
constexpr std::size_t kFewestTriangles = 3;
constexpr std::size_t kCoverageSamples = 2000;
constexpr SurfaceErrorOptions kMeasured;  // what counts as covered
constexpr double kWellCovered = 0.97;
// What the other end must cover more, and stubs, which may be bumps.
constexpr double kWorthTurning = 0.01, kWorthStubs = 0.05;

// One connected piece, its holes filled, ready to be cut.
struct Piece {
  TriangleMesh mesh;
  MeshEdges edges;
};

Piece prepare(const TriangleMesh& component, const MeshEdges& edges, std::span<const BoundaryLoop> loops) {
  Piece piece{fillLoops(component, edges, loops), {}};
  piece.edges = buildEdges(piece.mesh);
  return piece;
}

// Radius of a tube from its surface: 2 V / A where the volume can be trusted, and never beyond what one
// unbranched tube of the farthest distance would have.
float typicalRadius(const TriangleMesh& mesh, float reach) {
  const double area = mesh.area();
  const double fromLength = area / (2 * double(kPi) * std::max(double(reach), 1e-9));
  return float(std::clamp(2 * std::abs(mesh.volume()) / area, 0.2 * fromLength, fromLength));
}

struct PieceAxes {
  AxisGraph graph;
  std::vector<std::vector<vec4>> sections;
  PruneReport pruned;
};

// Drops rough points nearer than `distance` to the chain's start, but leaves at least two.
void trimStart(std::vector<vec4>& points, vec3 from, float distance) {
  std::size_t drop = 0;
  while (drop + 2 < points.size() && glm::distance(vec3(points[drop]), from) < distance) ++drop;
  points.erase(points.begin(), points.begin() + std::ptrdiff_t(drop));
}

float tipRadius(const std::vector<vec4>& points, bool last) {
  const std::size_t count = std::min<std::size_t>(7, points.size());
  std::vector<float> radii;
  for (std::size_t i = 0; i < count; ++i) radii.push_back(points[last ? points.size() - 1 - i : i].w);
  std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(count / 2), radii.end());
  return radii[count / 2];
}

// Whether the slices lost the way: part of the rough axis lies well outside what they found.
bool strays(const std::vector<vec4>& rough, const std::vector<vec4>& sections) {
  if (sections.size() < 2) return rough.size() >= 2;
  std::size_t from = 0;  // both run in the same direction, so the search only moves on
  for (const vec4& p : rough) {
    float best = std::numeric_limits<float>::infinity();
    std::size_t at = from;
    for (std::size_t i = from; i + 1 < sections.size(); ++i) {
      const vec3 a(sections[i]), b(sections[i + 1]);
      const float d = glm::distance(vec3(p), glm::mix(a, b, closestOnSegment(vec3(p), a, b))) -
                      std::max({p.w, sections[i].w, sections[i + 1].w}) * 1.5f;
      if (d < best) best = d, at = i;
      if (best <= 0 && i > at + 8) break;
    }
    if (best > 0) return true;
    from = at > 2 ? at - 2 : 0;
  }
  return false;
}

PieceAxes axesByLevelSets(const Piece& piece, std::span<const float> distance, float reach, bool keepStubs,
                          const ElementOptions& options) {
  PieceAxes result;
  const float radius = typicalRadius(piece.mesh, reach);
  const float finest =
      reach / float(std::min(kMostSections, kSectionsATriangle * piece.mesh.triangles.size()));
  const float step = std::max({0.5f * radius, std::min(0.25f * options.detail, 0.1f * reach), finest});
  result.graph = reebGraph(piece.mesh, piece.edges, distance, step);
  result.pruned = prune(result.graph, options.detail, keepStubs);

  const TriangleTree tree(piece.mesh);
  Slicer slicer(piece.mesh, piece.edges, tree);
  const auto ends = chainEnds(result.graph);
  for (std::uint32_t i = 0; i < result.graph.chains.size(); ++i) {
    const AxisChain& chain = result.graph.chains[i];
    std::vector<vec4> rough = chain.points;
    const auto trim = [&](std::uint32_t node, bool last) {
      float distanceFrom = tipRadius(chain.points, last);  // level sets near a tip are askew
      if (ends[node].size() > 1) {
        distanceFrom = 0;
        for (const ChainEnd& end : ends[node])
          if (end.chain != i || end.last != last)
            distanceFrom = std::max(distanceFrom, tipRadius(result.graph.chains[end.chain].points, end.last));
      }
      if (last) std::reverse(rough.begin(), rough.end());
      trimStart(rough, result.graph.nodes[node], distanceFrom);
      if (last) std::reverse(rough.begin(), rough.end());
    };
    trim(chain.start, false);
    trim(chain.end, true);
    std::vector<vec4> sections = reslice(slicer, rough, std::max(0.25f * options.detail, finest));
    if (strays(rough, sections)) {
      sections = rough;
      smoothSections(sections, 12);
    }
    if (sections.size() >= 2) {
      const float limit = 0.5f * chain.length + 4 * radius;
      if (ends[chain.end].size() == 1) extendToEnd(slicer, sections, limit);
      if (ends[chain.start].size() == 1) {
        std::reverse(sections.begin(), sections.end());
        extendToEnd(slicer, sections, limit);
        std::reverse(sections.begin(), sections.end());
      }
    }
    result.sections.push_back(std::move(sections));
  }
  connectForks(result.graph, result.sections, tree);
  for (std::vector<vec4>& sections : result.sections) dropUntold(sections, piece.mesh, tree);
  return result;
}

// Share of the surface that lies near the tubes' walls: of some triangles, by their middles.
double coverageOf(const TriangleMesh& mesh, const PieceAxes& axes) {
  const std::size_t stride = std::max<std::size_t>(1, mesh.triangles.size() / kCoverageSamples);
  double area = 0, covered = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += stride) {
    checkpoint();
    const uvec3& t = mesh.triangles[k];
    const vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const double own = glm::length(glm::cross(b - a, c - a));
    const auto isNear = [middle = (a + b + c) / 3.0f](const std::vector<vec4>& sections) {
      if (sections.size() < 2) return false;
      const Along at = nearestAlong(sections, middle);
      return std::abs(at.distance - at.section.w) <=
             std::max(kMeasured.coverLeast, kMeasured.coverRadii * at.section.w);
    };
    area += own;
    if (std::ranges::any_of(axes.sections, isNear)) covered += own;
  }
  return area > 0 ? covered / area : 0;
}

// A front finds what it meets as rings, and misses what is shorter than half its girth: where the axes leave
// surface uncovered, fronts from the other end and stubs are tried, too.
PieceAxes axesByLevelSets(const Piece& piece, const ElementOptions& options) {
  const VertexTriangles around = buildVertexTriangles(piece.mesh);
  const auto from = [&](std::uint32_t source) { return surfaceDistance(piece.mesh, around, {&source, 1}); };
  std::array<std::vector<float>, 2> distances{from(farthest(from(0)))};
  const std::uint32_t other = farthest(distances[0]);
  const float reach = distances[0][other];
  PieceAxes best;
  if (!(reach > 0)) return best;
  double covered = -1;
  for (const bool keepStubs : {false, true})
    for (std::vector<float>& distance : distances) {
      if (distance.empty()) distance = from(other);
      PieceAxes axes = axesByLevelSets(piece, distance, reach, keepStubs, options);
      const double own = coverageOf(piece.mesh, axes);
      if (own > covered + (keepStubs ? kWorthStubs : kWorthTurning)) covered = own, best = std::move(axes);
      if (covered > kWellCovered) return best;
    }
  return best;
}

PieceAxes axesOfRings(const std::vector<vec4>& sections) {
  PieceAxes axes;
  axes.graph.nodes = {vec3(sections.front()), vec3(sections.back())};
  axes.graph.chains = {{0, 1, sections, polylineLength(sections)}};
  axes.sections = {sections};
  return axes;
}

// Neighbouring sections that coincide become one; end sections stay.
void separate(std::vector<vec4>& sections, float minimumRadius) {
  std::vector<vec4> kept;
  for (vec4 s : sections) {
    s.w = std::max(s.w, minimumRadius);
    if (!kept.empty() && glm::distance(vec3(kept.back()), vec3(s)) < 0.01f * s.w) continue;
    kept.push_back(s);
  }
  if (kept.size() > 1) kept.back() = vec4(vec3(sections.back()), std::max(sections.back().w, minimumRadius));
  sections = std::move(kept);
}

void add(ElementSkeleton& skeleton, PieceAxes&& axes, float minimumRadius) {
  const auto base = std::uint32_t(skeleton.nodes.size());
  for (const vec3& position : axes.graph.nodes) skeleton.nodes.push_back({position, 0});
  for (std::size_t i = 0; i < axes.graph.chains.size(); ++i) {
    const AxisChain& chain = axes.graph.chains[i];
    ElementBranch branch{std::move(axes.sections[i]), base + chain.start, base + chain.end};
    separate(branch.sections, minimumRadius);
    if (branch.sections.size() < 2) continue;
    ++skeleton.nodes[branch.startNode].valence;
    ++skeleton.nodes[branch.endNode].valence;
    branch.sections.front() = vec4(skeleton.nodes[branch.startNode].position, branch.sections.front().w);
    branch.sections.back() = vec4(skeleton.nodes[branch.endNode].position, branch.sections.back().w);
    skeleton.branches.push_back(std::move(branch));
  }
}

void note(std::string& reason, const std::string& text) {
  if (!reason.empty()) reason += "; ";
  reason += text;
}

}  // namespace

ElementSkeleton skeletonise(const TriangleMesh& mesh, const ElementOptions& options) {
  ElementSkeleton skeleton;
  const TriangleMesh clean = weld(mesh, options.weldTolerance);
  if (clean.empty()) {
    skeleton.reason = mesh.empty() ? "no triangles" : "no usable triangle";
    return skeleton;
  }
  const std::vector<TriangleMesh> components = splitComponents(clean);
  skeleton.componentsTotal = std::uint32_t(components.size());
  skeleton.triangles = clean.triangles.size();
  const double area = clean.area();
  std::uint32_t debris = 0, splinters = 0, shapeless = 0, byRings = 0, byLevels = 0;
  for (const TriangleMesh& component : components) {
    if (component.area() < options.debrisShare * area) {
      ++debris;
      continue;
    }
    if (component.triangles.size() < kFewestTriangles) {
      ++splinters;
      continue;
    }
    const MeshEdges edges = buildEdges(component);
    const auto loops = boundaryLoops(component, edges);
    const auto rings = options.useRings ? traceRings(component, edges, loops) : std::nullopt;
    const std::size_t before = skeleton.branches.size();
    add(skeleton, rings ? axesOfRings(*rings) : axesByLevelSets(prepare(component, edges, loops), options),
        options.minimumRadius);
    if (skeleton.branches.size() == before)
      ++shapeless;
    else
      ++(rings ? byRings : byLevels);
  }
  skeleton.componentsUsed = byRings + byLevels;
  if (byRings > 0)
    skeleton.method = byLevels > 0 ? "rings and level sets" : "rings";
  else if (byLevels > 0)
    skeleton.method = "level sets";
  const std::uint32_t bridged = bridgeGaps(skeleton, options.bridgeRadii, options.detail);
  dropUnusedNodes(skeleton);
  if (bridged > 0) note(skeleton.reason, std::to_string(bridged) + " gaps bridged");
  if (debris > 0) note(skeleton.reason, std::to_string(debris) + " pieces too small");
  if (splinters > 0) note(skeleton.reason, std::to_string(splinters) + " pieces of one or two triangles");
  if (shapeless > 0) note(skeleton.reason, std::to_string(shapeless) + " pieces without an axis");
  return skeleton;
}

}  // namespace vasa
