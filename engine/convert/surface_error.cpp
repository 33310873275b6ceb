#include "convert/surface_error.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "convert/tube_tree.h"
#include "core/cancellation.h"
#include "core/parallel.h"
#include "curve/frame.h"
#include "mesh/surface_samples.h"
#include "mesh/triangle_tree.h"

namespace vasa {
namespace {

constexpr float kLargestError = 0.5f;   // [m] no error is told larger
constexpr float kInsideMargin = 1e-5f;  // [m]

// For each vessel those that share a node with it, itself included.
std::vector<std::set<std::uint32_t>> neighboursOf(const Network& network) {
  std::vector<std::set<std::uint32_t>> result(network.vessels().size());
  for (std::uint32_t v = 0; v < result.size(); ++v) result[v].insert(v);
  for (const Node& node : network.nodes()) {
    std::set<std::uint32_t> here;
    if (node.host) here.insert(node.host->vessel.value);
    for (const VesselEnd& end : network.ends(node)) here.insert(end.vessel.value);
    for (const std::uint32_t v : here) result[v].insert(here.begin(), here.end());
  }
  return result;
}

struct Measurer {
  const Assembly& assembly;
  std::span<const SourceElement> elements;
  const SurfaceErrorOptions& options;
  std::vector<std::set<std::uint32_t>> neighbours;
  TubeTree whole;

  std::set<std::uint32_t> vesselsAround(std::span<const std::uint32_t> vessels) const {
    std::set<std::uint32_t> all;
    for (const std::uint32_t v : vessels) all.insert(neighbours[v].begin(), neighbours[v].end());
    return all;
  }
  std::span<const vec4> pointsOf(std::uint32_t vessel) const {
    return assembly.network.pointsOf(assembly.network.vessels()[vessel]);
  }

  void forward(const TriangleMesh& mesh, const std::set<std::uint32_t>& vessels, ElementError& error) const {
    const auto wanted = std::uint32_t(error.area / options.sampleArea);
    const auto samples = sampleSurface(mesh, std::clamp(wanted, options.samplesMin, options.samplesMax));
    if (samples.empty()) return;
    std::vector<TubePiece> pieces;
    for (const std::uint32_t v : vessels) appendPieces(pointsOf(v), v, pieces);
    const TubeTree tree(std::move(pieces));
    std::size_t covered = 0;
    Checkpoints checkpoints;
    for (const vec3& p : samples) {
      checkpoints.pass();
      const TubeTree::Hit hit = tree.nearestWall(p, kLargestError);
      const float distance = std::abs(hit.distance);
      error.forward.distances.push_back(distance);
      covered += distance <= std::max(options.coverLeast, options.coverRadii * hit.radius);
    }
    error.forward.areaEach = float(error.area / double(samples.size()));
    error.coverage = double(covered) / double(samples.size());
  }

  // The wall at equal steps of parameter and angle, each sample for its share of the wall's area; the samples
  // are then thinned to equal areas by repeating none and skipping by the running sum.
  void backward(std::span<const std::uint32_t> own, std::span<const TriangleTree* const> meshes,
                ElementError& error) const {
    double wallArea = 0;
    for (const std::uint32_t v : own) wallArea += wallAreaOf(pointsOf(v));
    const double wanted =
        std::clamp(wallArea / options.sampleArea, double(options.samplesMin), double(options.samplesMax));
    const double areaEach = wallArea / wanted;
    double reached = 0, next = 0.5 * areaEach;
    for (const std::uint32_t v : own) {
      const auto points = pointsOf(v);
      const std::uint32_t steps = 16 * spanCount(points);
      vec3 u = anyPerpendicular(unitTangent(points, 0));
      for (std::uint32_t i = 0; i < steps; ++i) {
        checkpoint();
        const float parameter = (float(i) + 0.5f) / 16;
        const vec4 section = evaluate(points, parameter), slope = evaluateDerivative(points, parameter);
        const vec3 tangent = unitTangent(points, parameter);
        u = glm::normalize(u - glm::dot(u, tangent) * tangent + 1e-12f * anyPerpendicular(tangent));
        reached += double(glm::length(vec3(slope))) / 16 * 2 * kPi * section.w;
        for (std::uint32_t turn = 0; next < reached; next += areaEach, ++turn) {
          // The golden angle spreads the samples of following rings round the tube.
          const float angle = 2.3999632f * float(error.backward.distances.size() + turn + i);
          const vec3 normal = std::cos(angle) * u + std::sin(angle) * glm::cross(tangent, u);
          const vec3 p = vec3(section) + section.w * normal;
          if (!whole.insideAnother(p, v, kInsideMargin))
            error.backward.distances.push_back(distanceTo(meshes, p));
        }
      }
    }
    error.backward.areaEach = float(areaEach);
  }
  static float distanceTo(std::span<const TriangleTree* const> meshes, vec3 p) {
    float best = kLargestError;
    for (const TriangleTree* mesh : meshes) best = std::min(best, mesh->nearest(p, best).distance);
    return best;
  }
  static double wallAreaOf(std::span<const vec4> points) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 16 * spanCount(points); ++i) {
      const float parameter = (float(i) + 0.5f) / 16;
      sum += double(glm::length(vec3(evaluateDerivative(points, parameter)))) / 16 * 2 * kPi *
             evaluate(points, parameter).w;
    }
    return sum;
  }
};

}  // namespace

ErrorStatistics statisticsOf(std::span<const WeightedErrors> parts) {
  std::vector<std::pair<float, float>> all;  // distance, area
  double area = 0, sum = 0;
  for (const WeightedErrors& part : parts)
    for (const float distance : part.distances) {
      all.push_back({distance, part.areaEach});
      area += part.areaEach, sum += double(distance) * part.areaEach;
    }
  if (all.empty() || !(area > 0)) return {};
  std::ranges::sort(all);
  double reached = 0;
  float p95 = all.back().first;
  for (const auto& [distance, weight] : all)
    if ((reached += weight) >= 0.95 * area) {
      p95 = distance;
      break;
    }
  return {float(sum / area), p95, all.back().first, true};
}

std::vector<ElementError> measureSurfaceErrors(const Assembly& assembly,
                                               std::span<const SourceElement> elements,
                                               std::span<const std::vector<std::uint32_t>> standIn,
                                               const SurfaceErrorOptions& options) {
  std::vector<TubePiece> pieces;
  for (std::uint32_t v = 0; v < assembly.network.vessels().size(); ++v)
    appendPieces(assembly.network.pointsOf(assembly.network.vessels()[v]), v, pieces);
  const Measurer measurer{assembly, elements, options, neighboursOf(assembly.network),
                          TubeTree(std::move(pieces))};
  std::vector<std::unique_ptr<TriangleTree>> trees(elements.size());
  parallelFor(elements.size(), 8,
              [&](std::size_t e) { trees[e] = std::make_unique<TriangleTree>(elements[e].element.mesh); });
  std::vector<ElementError> errors(elements.size());
  parallelFor(elements.size(), 1, [&](std::size_t e) {
    const TriangleMesh& mesh = elements[e].element.mesh;
    const auto& own = assembly.vesselsOf[e];
    errors[e].area = mesh.area();
    std::vector<std::uint32_t> basis = own;
    if (e < standIn.size())
      for (const std::uint32_t other : standIn[e])
        basis.insert(basis.end(), assembly.vesselsOf[other].begin(), assembly.vesselsOf[other].end());
    const std::set<std::uint32_t> around = measurer.vesselsAround(basis);
    if (around.empty()) return;
    measurer.forward(mesh, around, errors[e]);
    if (own.empty()) return;
    std::set<std::uint32_t> meshes{std::uint32_t(e)};
    for (const std::uint32_t v : around) meshes.insert(assembly.elementOf[v]);
    std::vector<const TriangleTree*> list;
    for (const std::uint32_t m : meshes) list.push_back(trees[m].get());
    measurer.backward(own, list, errors[e]);
  });
  return errors;
}

}  // namespace vasa
