#include "surface/fork_stump.h"

#include <algorithm>

#include "surface/fork_check.h"
#include "surface/fork_smooth.h"
#include "surface/fork_template.h"

// Why a stump cannot fold: its vertices' normals are the directions d of the ring's vertices. A face between
// directions d and d' beside each other has an edge along τ, at right angles to their middle e and to the
// inward direction i, and another edge w; its normal τ × w has no part along τ, and along e the part (w · i)
// |τ|, which is positive as all steps go inwards. Sums of normals at its corners lie nearer to e than to -e
// for three directions and more. So the two agree whatever the pose, and however askew the way to the tip.
namespace vasa {
namespace {

constexpr float kStumpWide = 0.8f;   // share of the way to the tip
constexpr float kStumpLeast = 0.5f;  // depth in radii

vec3 directionOf(const Section& ring, vec2 direction) {
  return direction.x * ring.frame.u + direction.y * ring.frame.v;
}

// StumpRows of a stump.
struct StumpRows {
  std::uint32_t ring, wide, tip;
};

void write(const Stump& stump, const ForkShape& shape, const ForkSeam& seam, StumpRows rows,
           std::span<SurfacePoint> vertices) {
  const std::uint32_t around = shape.rowSize(rows.ring);
  const std::vector<vec2> directions = ringDirections(around);
  const vec3 tip = stump.tip(), wide = stump.ring.centre + kStumpWide * (tip - stump.ring.centre);
  for (std::uint32_t k = 0; k < around; ++k) {
    const vec3 d = directionOf(stump.ring, directions[seam.direction(k, around)]);
    vertices[shape.rowStart(rows.ring) + k].normal = d;
    if (rows.wide != rows.tip) vertices[shape.rowStart(rows.wide) + k] = {wide + stump.ring.radius * d, d};
  }
  // The tip's row may have another number of vertices.
  const std::uint32_t count = shape.rowSize(rows.tip);
  for (std::uint32_t k = 0; k < count; ++k)
    vertices[shape.rowStart(rows.tip) + k] = {
        tip, directionOf(stump.ring, directions[seam.direction((k * around + count / 2) / count, around)])};
}

bool anyFolds(std::span<const SurfacePoint> vertices, const std::vector<uvec3>& triangles) {
  return std::ranges::any_of(
      triangles, [&](const uvec3& t) { return folds(vertices[t.x], vertices[t.y], vertices[t.z]); });
}

}  // namespace

vec3 Stump::tip() const {
  const vec3 way = towards - ring.centre;
  const float depth = way.x * inward.x + way.y * inward.y + way.z * inward.z;
  return towards + std::max(kStumpLeast * ring.radius - depth, 0.0f) * inward;
}

ForkSteps smoothFolds(const ForkShape& shape, const ForkLayout& layout, std::span<SurfacePoint> vertices,
                      bool turns) {
  const std::span<const SurfacePoint> turning = turns ? vertices : std::span<SurfacePoint>();
  ForkSteps steps;
  for (std::uint32_t step = 0; step < shared::kMostSmoothings; ++step) {
    std::array<bool, shared::kMostBranches> folded{};
    for (std::uint32_t i = 0; i < shape.branchCount; ++i)
      folded[i] = anyFolds(vertices, branchTriangles(shape, layout, i, turning));
    const bool trunk = anyFolds(vertices, trunkTriangles(shape, layout, turning));
    if (!trunk && std::ranges::none_of(folded, std::identity{})) break;
    if (trunk) smoothTrunk(shape, vertices), ++steps.trunk;
    for (std::uint32_t i = 0; i < shape.branchCount; ++i)
      if (folded[i]) smoothCollar(shape, layout, i, vertices), ++steps.collar[i];
  }
  return steps;
}

void ForkStumps::replaceFolds(const ForkShape& shape, ForkLayout& layout, std::span<SurfacePoint> vertices,
                              bool turns) const {
  const std::span<const SurfacePoint> turning = turns ? vertices : std::span<SurfacePoint>();
  for (std::uint32_t i = 0; i < shape.branchCount; ++i)
    layout.stump[i] = anyFolds(vertices, branchTriangles(shape, layout, i, turning));
  layout.cut = anyFolds(vertices, trunkTriangles(shape, layout, turning));
  if (layout.cut) {
    write(a, shape, layout.a, {0, 1, 2}, vertices);
    write(b, shape, layout.b, {shared::kTrunkRows - 1, shared::kTrunkRows - 2, shared::kTrunkRows - 2},
          vertices);
  }
  for (std::uint32_t i = 0; i < shape.branchCount; ++i) {
    layout.stump[i] = layout.stump[i] || layout.cut;
    const std::uint32_t ring = branchRow(i);
    if (layout.stump[i]) write(branch[i], shape, layout.branch[i], {ring, ring - 1, ring - 2}, vertices);
  }
}

}  // namespace vasa
