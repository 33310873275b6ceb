#include "surface/fork_check.h"

#include "surface/fork_template.h"

namespace vasa {

std::uint32_t foldedTriangles(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around) {
  const ForkShape shape = forkShape(network.table, fork, [around](std::uint32_t) { return around; });
  std::vector<SurfacePoint> points(shape.vertices());
  const ForkLayout layout = evaluateFork(network, fork, shape, points);
  std::uint32_t count = 0;
  for (const uvec3& t : forkTriangles(shape, std::span(layout.window).first(fork.branchCount))) {
    const dvec3 a(points[t.x].position), b(points[t.y].position), c(points[t.z].position);
    const dvec3 normals(points[t.x].normal + points[t.y].normal + points[t.z].normal);
    count += glm::dot(glm::cross(b - a, c - a), normals) <= 0;
  }
  return count;
}

}  // namespace vasa
