#include "convert/wall_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/cancellation.h"
#include "core/disjoint_sets.h"
#include "math/direction.h"
#include "mesh/components.h"
#include "mesh/triangle_tree.h"

namespace vasa {
namespace {

constexpr std::size_t kTried = 200;  // triangles, before all are looked at
// Of the surface. An inside that could be a wall's is 0.29 of it (0.4 of the outside's radius, hollow.cpp).
constexpr double kLeastInside = 0.2;
// Of seven: the normal and six a third of a right angle above the surface. At an opening half of them go out.
constexpr int kRays = 6, kEnclosing = 4;
constexpr float kAbove = 0.5f;  // sine of that

struct Looker {
  const TriangleMesh& mesh;
  TriangleTree tree{mesh};
  float side = mesh.volume() < 0 ? -1.0f : 1.0f;

  // Whether triangle `t` looks at the surface nearly wherever it looks.
  bool enclosed(std::uint32_t t) const {
    const uvec3& corners = mesh.triangles[t];
    const vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
    const vec3 normal = side * unitOr(glm::cross(b - a, c - a), vec3(0)), along = unitOr(b - a, vec3(0));
    if (normal == vec3(0) || along == vec3(0)) return false;
    const vec3 across = glm::cross(normal, along), from = (a + b + c) / 3.0f;
    int hits = tree.hits(from, normal, t);
    for (int k = 0; k < kRays && hits < kEnclosing && hits + kRays - k >= kEnclosing; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * float(k) / float(kRays);
      const vec3 level = std::cos(angle) * along + std::sin(angle) * across;
      hits += tree.hits(from, kAbove * normal + std::sqrt(1 - kAbove * kAbove) * level, t);
    }
    return hits >= kEnclosing;
  }
};

double areaOf(const TriangleMesh& mesh, std::uint32_t t) {
  const uvec3& corners = mesh.triangles[t];
  const vec3 a = mesh.positions[corners.x];
  return 0.5 * double(glm::length(glm::cross(mesh.positions[corners.y] - a, mesh.positions[corners.z] - a)));
}

bool looksAtItself(const Looker& looker) {
  const std::size_t count = looker.mesh.triangles.size(), stride = std::max<std::size_t>(1, count / kTried);
  double enclosed = 0, all = 0;
  for (std::size_t t = 0; t < count; t += stride) {
    const double area = areaOf(looker.mesh, std::uint32_t(t));
    all += area;
    if (looker.enclosed(std::uint32_t(t))) enclosed += area;
  }
  return enclosed > kLeastInside * all;
}

}  // namespace

std::optional<WallFaces> splitAtRims(const TriangleMesh& piece) {
  if (piece.empty()) return std::nullopt;
  const Looker looker{piece};
  if (!looksAtItself(looker)) return std::nullopt;
  const auto count = std::uint32_t(piece.triangles.size());
  std::vector<char> enclosed(count);
  Checkpoints checkpoints;
  for (std::uint32_t t = 0; t < count; ++t) checkpoints.pass(), enclosed[t] = looker.enclosed(t);
  // Patches: triangles that look at the surface and share corners.
  DisjointSets patches(piece.positions.size());
  for (std::uint32_t t = 0; t < count; ++t)
    if (enclosed[t])
      for (int k = 1; k < 3; ++k) patches.unite(piece.triangles[t].x, piece.triangles[t][k]);
  std::vector<double> areas(piece.positions.size(), 0);
  for (std::uint32_t t = 0; t < count; ++t)
    if (enclosed[t]) areas[patches.find(piece.triangles[t].x)] += areaOf(piece, t);
  const auto largest = std::uint32_t(std::ranges::max_element(areas) - areas.begin());
  std::array<std::vector<std::uint32_t>, 2> faces;
  for (std::uint32_t t = 0; t < count; ++t)
    faces[enclosed[t] && patches.find(piece.triangles[t].x) == largest].push_back(t);
  return WallFaces{partOf(piece, faces[0]), partOf(piece, faces[1])};
}

}  // namespace vasa
