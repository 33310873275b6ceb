#include "convert/wall_sides.h"

#include <limits>

#include "mesh/edges.h"

namespace vasa {
namespace {

vec3 nearestOf(std::span<const vec3> places, vec3 p) {
  vec3 nearest(0);
  float least = std::numeric_limits<float>::infinity();
  for (const vec3& place : places) {
    const vec3 d = place - p;
    const float distance2 = glm::dot(d, d);
    if (distance2 < least) least = distance2, nearest = place;
  }
  return nearest;
}

bool runsAlong(const uvec3& triangle, std::uint32_t from, std::uint32_t to) {
  for (int k = 0; k < 3; ++k)
    if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
  return false;
}

// Makes the triangles around `first` look the same way as it. @return them
std::vector<std::uint32_t> align(TriangleMesh& mesh, const MeshEdges& edges, std::uint32_t first,
                                 std::vector<bool>& done) {
  std::vector<std::uint32_t> piece{first};
  done[first] = true;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const std::uint32_t t = piece[next];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t e = edges.ofTriangle[t][k];
      const auto both = edges.trianglesOf(e);
      if (both.size() != 2) continue;
      const std::uint32_t other = both[0] == t ? both[1] : both[0];
      if (done[other]) continue;
      const uvec2 v = edges.vertices[e];
      if (runsAlong(mesh.triangles[t], v.x, v.y) == runsAlong(mesh.triangles[other], v.x, v.y))
        std::swap(mesh.triangles[other].y, mesh.triangles[other].z);
      done[other] = true;
      piece.push_back(other);
    }
  }
  return piece;
}

}  // namespace

void turnOutward(TriangleMesh& mesh, std::span<const vec3> axes) {
  const MeshEdges edges = buildEdges(mesh);
  std::vector<bool> done(mesh.triangles.size());
  for (std::uint32_t first = 0; first < mesh.triangles.size(); ++first) {
    if (done[first]) continue;
    const std::vector<std::uint32_t> piece = align(mesh, edges, first, done);
    float away = 0;
    for (const std::uint32_t t : piece) {
      const vec3 &a = mesh.positions[mesh.triangles[t].x], &b = mesh.positions[mesh.triangles[t].y];
      const vec3 &c = mesh.positions[mesh.triangles[t].z], middle = (a + b + c) / 3.0f;
      const vec3 out = middle - nearestOf(axes, middle);
      away += glm::dot(glm::cross(b - a, c - a), out) / std::max(glm::length(out), 1e-12f);
    }
    if (away >= 0) continue;
    for (const std::uint32_t t : piece) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
  }
}

}  // namespace vasa
