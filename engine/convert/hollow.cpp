#include "convert/hollow.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "convert/duplicates.h"
#include "convert/wall_faces.h"
#include "core/cancellation.h"
#include "core/parallel.h"
#include "mesh/components.h"
#include "mesh/surface_samples.h"
#include "mesh/triangle_tree.h"
#include "mesh/weld.h"
#include "mesh/winding_number.h"

namespace vasa {
namespace {

constexpr std::size_t kSamples = 200;
constexpr float kNearlyAll = 0.85f;  // of the samples, as elements that repeat others have (duplicates.h)
// Of the outside's radius: walls of arteries are up to a third of it thick, stiff and narrowed ones half.
constexpr float kThickest = 0.6f;
// Of it, too: a coarser copy lies inside as well, but for its corners, which are on the surface.
constexpr float kThinnest = 0.03f;
constexpr double kLeastShare = 0.1;   // of the outside's area: less cannot be a wall's inside
constexpr double kLeastOfAll = 0.01;  // of the surface: an outside has more

template <class Test>
bool nearlyAll(std::span<const vec3> samples, const Test& test) {
  std::size_t count = 0;
  Checkpoints checkpoints;
  for (const vec3& p : samples) checkpoints.pass(), count += test(p);
  return !samples.empty() && float(count) >= kNearlyAll * float(samples.size());
}

bool liesInside(const TriangleMesh& inner, const WindingNumber& winding) {
  return nearlyAll(sampleSurface(inner, kSamples), [&](vec3 p) { return std::abs(winding.at(p)) > 0.5f; });
}

bool liesAlong(const TriangleMesh& outer, const TriangleMesh& inner) {
  const TriangleTree tree(inner);
  const float thickest = kThickest * roughRadius(outer);
  return nearlyAll(sampleSurface(outer, kSamples),
                   [&](vec3 p) { return tree.nearest(p, thickest).distance < thickest; });
}

bool standsOff(const TriangleMesh& outer, const TriangleMesh& inner) {
  const TriangleTree tree(outer);
  const float thinnest = kThinnest * roughRadius(outer);
  std::vector<vec3> corners;
  for (std::size_t v = 0; v < inner.positions.size(); v += 1 + inner.positions.size() / kSamples)
    corners.push_back(inner.positions[v]);
  return nearlyAll(corners, [&](vec3 p) { return tree.nearest(p, thinnest).distance >= thinnest; });
}

bool couldLieIn(const Aabb& inner, const Aabb& outer) {
  const float slack = 0.05f * glm::length(outer.extent());  // open ends may stand out
  return glm::all(glm::greaterThanEqual(inner.low, outer.low - slack)) &&
         glm::all(glm::lessThanEqual(inner.high, outer.high + slack));
}

}  // namespace

// With the inside of its wall alone, where the piece goes on around its rims.
std::optional<TriangleMesh> insideOf(const TriangleMesh& piece) {
  std::optional<WallFaces> faces = splitAtRims(piece);
  if (!faces || faces->inside.area() >= faces->outside.area()) return std::nullopt;
  const WindingNumber winding(faces->outside.positions, faces->outside.triangles);
  if (!liesInside(faces->inside, winding) || !liesAlong(faces->outside, faces->inside)) return std::nullopt;
  return std::move(faces->inside);
}

std::optional<TriangleMesh> withoutOuterWalls(const TriangleMesh& mesh, float weldTolerance) {
  const std::vector<TriangleMesh> pieces = splitComponents(weld(mesh, weldTolerance));
  std::vector<Aabb> boxes;
  std::vector<double> areas;
  for (const TriangleMesh& piece : pieces) boxes.push_back(piece.bounds()), areas.push_back(piece.area());
  // Debris is no wall: so there are a hundred walls at most, and a thousand pieces that may lie in them.
  const double least = kLeastOfAll * std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (areas[i] > kLeastShare * least) large.push_back(i);
  const auto isWall = [&](std::size_t outer) {
    if (areas[outer] <= least) return false;
    std::optional<WindingNumber> winding;
    return std::ranges::any_of(large, [&](std::size_t inner) {
      if (inner == outer || areas[inner] >= areas[outer] || areas[inner] <= kLeastShare * areas[outer] ||
          !couldLieIn(boxes[inner], boxes[outer]))
        return false;
      if (!winding) winding.emplace(pieces[outer].positions, pieces[outer].triangles);
      return liesInside(pieces[inner], *winding) && liesAlong(pieces[outer], pieces[inner]);
    });
  };
  TriangleMesh left;
  bool any = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    checkpoint();
    const bool wall = isWall(i);
    const auto inside = wall || areas[i] <= least ? std::nullopt : insideOf(pieces[i]);
    any = any || wall || inside;
    if (!wall) appendMesh(left, inside ? *inside : pieces[i]);
  }
  if (!any) return std::nullopt;
  return left;
}

std::vector<bool> outerWalls(std::span<const SourceElement> elements) {
  const std::size_t count = elements.size();
  std::vector<Aabb> boxes(count);
  std::vector<float> radii(count);
  for (std::size_t e = 0; e < count; ++e)
    boxes[e] = elements[e].element.mesh.bounds(), radii[e] = roughRadius(elements[e].element.mesh);
  // A stent or a catheter lies inside, too, and is thinner than any lumen.
  const auto couldBe = [&](std::size_t outer, std::size_t inner) {
    const VesselKind own = elements[outer].kind, other = elements[inner].kind;
    const bool oneKind = own == VesselKind::other || other == VesselKind::other || sameFamily(own, other);
    return inner != outer && oneKind && radii[inner] < radii[outer] &&
           radii[inner] > (1 - kThickest) * radii[outer] && couldLieIn(boxes[inner], boxes[outer]) &&
           glm::length(boxes[inner].extent()) > kNearlyAll * glm::length(boxes[outer].extent());
  };
  std::vector<std::uint8_t> walls(count);
  parallelFor(count, 1, [&](std::size_t outer) {
    const TriangleMesh& wall = elements[outer].element.mesh;
    std::optional<WindingNumber> winding;
    for (std::size_t inner = 0; inner < count && !walls[outer]; ++inner) {
      if (wall.empty() || elements[inner].element.mesh.empty() || !couldBe(outer, inner)) continue;
      if (!winding) winding.emplace(wall.positions, wall.triangles);
      const TriangleMesh& lumen = elements[inner].element.mesh;
      walls[outer] = liesInside(lumen, *winding) && standsOff(wall, lumen) && liesAlong(wall, lumen);
    }
  });
  return {walls.begin(), walls.end()};
}

}  // namespace vasa
