#include "scene/film_baker.h"

#include <algorithm>

#include "mesh/shape_basis.h"
#include "surface/surface_mesh.h"

namespace vasa {
namespace {

// All frames share their triangles and move from key to key in straight lines, so forks stay as they are.
SurfaceMesh surface(const SweepTable& table, const PosedFrame& frame, const SweepShape& shape) {
  return surfaceMesh({table, frame.points, frame.knotFrames}, shape, ForkForm::bare);
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
  const SurfaceMesh mesh = surface(table_, film_.frames[0], shape);
  return {mesh.positions.size(), mesh.triangles.size()};
}

Bake FilmBaker::run(const SweepShape& shape) const {
  Bake result;
  result.shape = shape;
  SurfaceMesh first = surface(table_, film_.frames[0], shape);
  std::vector<std::vector<vec3>> positions, normals;
  for (const PosedFrame& frame : film_.frames) {
    SurfaceMesh mesh = surface(table_, frame, shape);
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
  result.betweenError = betweenError(mesh, shape);
  return result;
}

float FilmBaker::betweenError(const AnimatedMesh& mesh, const SweepShape& shape) const {
  float worst = 0;
  for (const Film::Between& place : film_.between) {
    const SurfaceMesh wanted = surface(table_, place.frame, shape);
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
