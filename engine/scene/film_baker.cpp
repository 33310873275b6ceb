#include "scene/film_baker.h"

#include <algorithm>

#include "core/parallel.h"
#include "mesh/shape_basis.h"
#include "surface/surface_mesh.h"

namespace vasa {
namespace {

// All frames share their triangles and move from key to key in straight lines, so forks are smoothed in all
// of them as in the one that asks for most.
std::vector<ForkSteps> stepsOfFilm(const SweepTable& table, const Film& film, const SweepShape& shape) {
  std::vector<ForkSteps> steps(table.forks.size());
  parallelFor(steps.size(), 4, [&](std::size_t i) {
    const ForkShape own = forkShape(table, table.forks[i], [&](std::uint32_t) { return shape.around; });
    std::vector<SurfacePoint> vertices(own.vertices());
    for (const PosedFrame& frame : film.frames) {
      const ForkSteps wanted =
          evaluateFork({table, frame.points, frame.knotFrames}, table.forks[i], own, vertices, nullptr, false)
              .steps;
      steps[i].trunk = std::max(steps[i].trunk, wanted.trunk);
      for (std::size_t k = 0; k < wanted.collar.size(); ++k)
        steps[i].collar[k] = std::max(steps[i].collar[k], wanted.collar[k]);
    }
  });
  return steps;
}

SurfaceMesh surface(const SweepTable& table, const PosedFrame& frame, const SweepShape& shape,
                    std::span<const ForkSteps> steps) {
  return surfaceMesh({table, frame.points, frame.knotFrames}, shape, steps);
}

// A part for each kind of vessel that there is.
void describe(const Network& network, const std::function<vec3(VesselKind)>& colourOf, SurfaceMesh& first,
              AnimatedMesh& mesh) {
  mesh.name = "vessels";
  const auto vessels = network.vessels();
  std::vector<AnimatedMesh::Part> parts(std::size_t(VesselKind::other) + 1);
  for (std::size_t kind = 0; kind < parts.size(); ++kind) {
    parts[kind].name = kindName(VesselKind(kind));
    if (colourOf) parts[kind].colour = colourOf(VesselKind(kind));
  }
  for (const uvec3& t : first.triangles) {
    if (first.positions[t.x] == first.positions[t.y] && first.positions[t.y] == first.positions[t.z])
      continue;
    parts[std::size_t(vessels[first.vesselOfVertex[t.x]].kind)].triangles.push_back(t);
  }
  std::erase_if(parts, [](const AnimatedMesh::Part& part) { return part.triangles.empty(); });
  mesh.parts = std::move(parts);
  if (vessels.size() <= 65535) {
    mesh.labelOfVertex.assign(first.vesselOfVertex.begin(), first.vesselOfVertex.end());
    for (const Vessel& vessel : vessels)
      mesh.labels.push_back({vessel.name, std::string(kindName(vessel.kind)), vessel.ontologyId});
  }
  mesh.positions = std::move(first.positions);
  mesh.normals = std::move(first.normals);
}

}  // namespace

FilmBaker::Size FilmBaker::sizeOf(const SweepShape& shape) const {
  const std::vector<ForkSteps> unsmoothed(table_.forks.size());
  const SurfaceMesh mesh = surface(table_, film_.frames[0], shape, unsmoothed);
  return {mesh.positions.size(), mesh.triangles.size()};
}

Bake FilmBaker::run(const SweepShape& shape) const {
  Bake result;
  result.shape = shape;
  const std::vector<ForkSteps> steps = stepsOfFilm(table_, film_, shape);
  SurfaceMesh first = surface(table_, film_.frames[0], shape, steps);
  std::vector<std::vector<vec3>> positions, normals;
  for (const PosedFrame& frame : film_.frames) {
    SurfaceMesh mesh = surface(table_, frame, shape, steps);
    positions.push_back(std::move(mesh.positions));
    if (options_.normals) normals.push_back(std::move(mesh.normals));
  }
  ShapeBasis basis = shapeBasis(positions, options_.tolerance);
  AnimatedMesh& mesh = result.mesh;
  if (!basis.shapes.empty() && options_.normals) mesh.normalShapes = shapesForWeights(normals, basis.weights);
  result.error = basis.error;
  mesh.shapes = std::move(basis.shapes);
  mesh.weights = std::move(basis.weights);
  if (!mesh.shapes.empty()) mesh.times = film_.times;
  if (!options_.normals) first.normals.clear();
  describe(network_, options_.colourOf, first, mesh);
  result.betweenError = betweenError(mesh, shape, steps);
  return result;
}

float FilmBaker::betweenError(const AnimatedMesh& mesh, const SweepShape& shape,
                              std::span<const ForkSteps> steps) const {
  float worst = 0;
  for (const Film::Between& place : film_.between) {
    const SurfaceMesh wanted = surface(table_, place.frame, shape, steps);
    const std::uint32_t at = place.key;
    for (std::size_t v = 0; v < wanted.positions.size(); ++v) {
      vec3 p = mesh.positions[v];
      for (std::size_t k = 0; k < mesh.shapes.size(); ++k)
        p += glm::mix(mesh.weights[at][k], mesh.weights[at + 1][k], place.share) * mesh.shapes[k][v];
      worst = std::max(worst, glm::distance(p, wanted.positions[v]));
    }
  }
  return worst;
}

}  // namespace vasa
