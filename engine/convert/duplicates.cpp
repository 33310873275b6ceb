#include "convert/duplicates.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/cancellation.h"
#include "core/parallel.h"
#include "mesh/surface_samples.h"
#include "mesh/triangle_tree.h"

namespace vasa {
namespace {

struct Cover {
  std::uint32_t by;
  float share;
};

float coveredShare(std::span<const vec3> samples, const TriangleTree& by, float tolerance) {
  std::size_t inside = 0;
  Checkpoints checkpoints;
  for (const vec3& p : samples) checkpoints.pass(), inside += by.nearest(p, tolerance).distance < tolerance;
  return float(inside) / float(samples.size());
}

}  // namespace

float roughRadius(const TriangleMesh& mesh) {
  const Aabb box = mesh.bounds();
  if (box.empty()) return 0;
  // Volume about the box's centre, so that an open mesh far from the origin gives no nonsense.
  const dvec3 centre(box.centre());
  double volume = 0;
  for (const uvec3& t : mesh.triangles)
    volume += glm::dot(dvec3(mesh.positions[t.x]) - centre,
                       glm::cross(dvec3(mesh.positions[t.y]) - centre, dvec3(mesh.positions[t.z]) - centre));
  const double area = mesh.area(), diagonal = glm::length(box.extent());
  const double radius = area > 0 ? 2 * std::abs(volume / 6) / area : 0;
  return float(std::max(radius, 0.001 * diagonal));
}

std::vector<std::optional<std::uint32_t>> findDuplicates(std::span<const SourceElement> elements,
                                                         const DuplicateOptions& options) {
  const std::size_t count = elements.size();
  std::vector<Aabb> boxes(count);
  std::vector<double> areas(count);
  std::vector<std::unique_ptr<TriangleTree>> trees(count);
  parallelFor(count, 8, [&](std::size_t i) {
    boxes[i] = elements[i].element.mesh.bounds();
    areas[i] = elements[i].element.mesh.area();
    trees[i] = std::make_unique<TriangleTree>(elements[i].element.mesh);
  });
  std::vector<std::vector<Cover>> covers(count);
  parallelFor(count, 4, [&](std::size_t i) {
    const auto samples = sampleSurface(elements[i].element.mesh, options.samples);
    if (samples.empty()) return;
    const float tolerance = std::clamp(options.toleranceRadii * roughRadius(elements[i].element.mesh),
                                       options.toleranceMin, options.toleranceMax);
    for (std::uint32_t j = 0; j < count; ++j) {
      if (j == i || !boxes[i].overlaps(boxes[j]) || !sameFamily(elements[i].kind, elements[j].kind)) continue;
      const float share = coveredShare(samples, *trees[j], tolerance);
      if (share >= options.covered) covers[i].push_back({j, share});
    }
  });
  // Smallest first: what is left at the end covers whatever was dropped on the way.
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return areas[a] != areas[b] ? areas[a] < areas[b] : a > b;
  });
  std::vector<std::optional<std::uint32_t>> coveredBy(count);
  for (const std::uint32_t i : order) {
    const Cover* best = nullptr;
    for (const Cover& cover : covers[i])
      if (!coveredBy[cover.by] && (!best || cover.share > best->share)) best = &cover;
    if (best) coveredBy[i] = best->by;
  }
  for (auto& by : coveredBy)  // a coverer may have been dropped later for a larger one
    while (by && coveredBy[*by]) by = coveredBy[*by];
  return coveredBy;
}

}  // namespace vasa
