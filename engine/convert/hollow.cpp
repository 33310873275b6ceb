#include "convert/hollow.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "convert/duplicates.h"
#include "core/cancellation.h"
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
constexpr double kLeastShare = 0.1;  // of the outside's area: less cannot be a wall's inside

template <class Test>
bool nearlyAll(std::span<const vec3> samples, const Test& test) {
  std::size_t count = 0;
  Checkpoints checkpoints;
  for (const vec3& p : samples) checkpoints.pass(), count += test(p);
  return !samples.empty() && float(count) >= kNearlyAll * float(samples.size());
}

bool liesInside(const TriangleMesh& inner, const TriangleMesh& outer) {
  const WindingNumber winding(outer.positions, outer.triangles);
  return nearlyAll(sampleSurface(inner, kSamples), [&](vec3 p) { return std::abs(winding.at(p)) > 0.5f; });
}

bool liesAlong(const TriangleMesh& outer, const TriangleMesh& inner) {
  const TriangleTree tree(inner);
  const float thickest = kThickest * roughRadius(outer);
  return nearlyAll(sampleSurface(outer, kSamples),
                   [&](vec3 p) { return tree.nearest(p, thickest).distance < thickest; });
}

bool couldLieIn(const Aabb& inner, const Aabb& outer) {
  const float slack = 0.05f * glm::length(outer.extent());  // open ends may stand out
  return glm::all(glm::greaterThanEqual(inner.low, outer.low - slack)) &&
         glm::all(glm::lessThanEqual(inner.high, outer.high + slack));
}

}  // namespace

std::optional<TriangleMesh> withoutOuterWalls(const TriangleMesh& mesh, float weldTolerance) {
  const std::vector<TriangleMesh> pieces = splitComponents(weld(mesh, weldTolerance));
  if (pieces.size() < 2) return std::nullopt;
  std::vector<Aabb> boxes;
  std::vector<double> areas;
  for (const TriangleMesh& piece : pieces) boxes.push_back(piece.bounds()), areas.push_back(piece.area());
  const double least = 0.01 * *std::ranges::max_element(areas);  // debris is no wall
  const auto isWallOf = [&](std::size_t outer, std::size_t inner) {
    return inner != outer && areas[inner] < areas[outer] && areas[inner] > kLeastShare * areas[outer] &&
           couldLieIn(boxes[inner], boxes[outer]) && liesInside(pieces[inner], pieces[outer]) &&
           liesAlong(pieces[outer], pieces[inner]);
  };
  TriangleMesh left;
  bool any = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    checkpoint();
    bool isWall = false;
    for (std::size_t j = 0; j < pieces.size() && areas[i] > least && !isWall; ++j) isWall = isWallOf(i, j);
    any |= isWall;
    if (isWall) continue;
    const auto first = std::uint32_t(left.positions.size());
    left.positions.insert(left.positions.end(), pieces[i].positions.begin(), pieces[i].positions.end());
    for (const uvec3& t : pieces[i].triangles) left.triangles.push_back(t + first);
  }
  if (!any) return std::nullopt;
  return left;
}

}  // namespace vasa
