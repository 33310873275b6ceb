#include "surface/fork_check.h"

#include <algorithm>

#include "surface/fork_template.h"
#include "surface/reference.h"

// The specification of shaders/lib/fork_stump.glsl: same operations in the same order.
namespace vasa {
namespace {

constexpr float kFlat2 = 1e-10f;  // square of the share

ForkShape evenShape(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around) {
  return forkShape(network.table, fork, [around](std::uint32_t) { return around; });
}

}  // namespace

bool folds(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
  const vec3 first = b.position - a.position, second = c.position - a.position;
  const vec3 normals = a.normal + b.normal + c.normal;
  const float along = dotOf(glm::cross(first, second), normals);
  return along <= 0 || along * along <= kFlat2 * dotOf(first, first) * dotOf(second, second);
}

std::uint32_t foldedTriangles(const PosedNetwork& network, const shared::ForkRecord& fork,
                              std::uint32_t around, const ForkSteps* fixed) {
  const ForkShape shape = evenShape(network, fork, around);
  std::vector<SurfacePoint> points(shape.vertices());
  const ForkLayout layout = evaluateFork(network, fork, shape, points, fixed);
  std::uint32_t count = 0;
  for (const uvec3& t : forkTriangles(shape, layout, fixed ? std::span<const SurfacePoint>() : points))
    count += folds(points[t.x], points[t.y], points[t.z]);
  return count;
}

ForkLayout settledFork(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around) {
  const ForkShape shape = evenShape(network, fork, around);
  std::vector<SurfacePoint> points(shape.vertices());
  return evaluateFork(network, fork, shape, points);
}

bool isStump(const ForkLayout& layout) {
  return layout.cut || std::ranges::any_of(layout.stump, std::identity{});
}

}  // namespace vasa
