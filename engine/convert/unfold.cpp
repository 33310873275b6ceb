#include "convert/unfold.h"

#include <algorithm>

#include "mesh/edges.h"
#include "surface/fork_check.h"

namespace vasa {
namespace {

constexpr int kSteps = 60, kAlone = 20;  // of these, so many without the neighbours
constexpr float kMiddleStep = 0.5f;      // of the way to the neighbours' middle

vec3 middleOfNeighbours(const TriangleMesh& mesh, const VertexTriangles& around, std::uint32_t vertex) {
  vec3 sum(0);
  float count = 0;
  for (const std::uint32_t t : around.of(vertex))
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles[t][k] != vertex) sum += mesh.positions[mesh.triangles[t][k]], ++count;
  return count > 0 ? sum / count : mesh.positions[vertex];
}

}  // namespace

std::vector<std::uint32_t> foldedTriangles(const TriangleMesh& mesh, std::span<const vec3> held) {
  std::vector<vec3> normals = vertexNormals(mesh);
  std::ranges::copy(held, normals.begin());
  std::vector<std::uint32_t> folded;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const uvec3& t = mesh.triangles[i];
    const auto corner = [&](std::uint32_t v) { return SurfacePoint{mesh.positions[v], normals[v]}; };
    if (folds(corner(t.x), corner(t.y), corner(t.z))) folded.push_back(i);
  }
  return folded;
}

std::size_t unfold(TriangleMesh& mesh, std::span<const vec3> held) {
  const VertexTriangles around = buildVertexTriangles(mesh);
  for (int step = 0;; ++step) {
    const std::vector<std::uint32_t> folded = foldedTriangles(mesh, held);
    if (folded.empty() || step == kSteps) return folded.size();
    std::vector<bool> moves(mesh.positions.size());
    const auto take = [&](std::uint32_t triangle) {
      for (int k = 0; k < 3; ++k) moves[mesh.triangles[triangle][k]] = true;
    };
    for (const std::uint32_t triangle : folded) {
      take(triangle);
      if (step < kAlone) continue;
      for (int k = 0; k < 3; ++k)
        for (const std::uint32_t beside : around.of(mesh.triangles[triangle][k])) take(beside);
    }
    std::vector<vec3> moved = mesh.positions;
    for (std::uint32_t v = std::uint32_t(held.size()); v < moved.size(); ++v)
      if (moves[v]) moved[v] = glm::mix(moved[v], middleOfNeighbours(mesh, around, v), kMiddleStep);
    mesh.positions.swap(moved);
  }
}

}  // namespace vasa
