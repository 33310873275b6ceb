#include "make_human/separate_sheets.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace vasa::human {
namespace {

/// An edge of the mesh with the triangles that have it, each with its direction and its angle around the
/// edge.
struct Wing {
  std::uint32_t triangle;
  bool forward;
  float angle;
};

std::vector<Wing> wingsOf(const TriangleMesh& mesh, std::uint32_t u, std::uint32_t v,
                          const std::vector<std::uint32_t>& around) {
  const vec3 axis = glm::normalize(mesh.positions[v] - mesh.positions[u]);
  const vec3 x = anyPerpendicular(axis), y = glm::cross(axis, x);
  std::vector<Wing> wings;
  for (std::uint32_t index : around) {
    const uvec3 t = mesh.triangles[index];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (!(a == u && b == v) && !(a == v && b == u)) continue;
      const vec3 out = mesh.positions[t[(i + 2) % 3]] - mesh.positions[u];
      wings.push_back({index, a == u, std::atan2(glm::dot(out, y), glm::dot(out, x))});
    }
  }
  return wings;
}

/// Gives two triangles an edge of their own, through a new point in its middle.
void splitEdge(TriangleMesh& mesh, std::uint32_t u, std::uint32_t v, std::uint32_t first,
               std::uint32_t second) {
  const std::uint32_t middle = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(0.5f * (mesh.positions[u] + mesh.positions[v]));
  for (std::uint32_t index : {first, second}) {
    uvec3 half = mesh.triangles[index];
    for (int i = 0; i < 3; ++i) {
      if (half[i] == u) mesh.triangles[index][i] = middle;
      if (half[i] == v) half[i] = middle;
    }
    mesh.triangles.push_back(half);
  }
}

/// The triangle that bounds the same piece of the solid: the next one through the solid, towards smaller
/// angles.
const Wing& partnerOf(const Wing& forward, const std::vector<Wing>& wings) {
  const auto turn = [&](const Wing& wing) {
    const float angle = forward.angle - wing.angle;
    return angle > 0 ? angle : angle + 2 * kPi;
  };
  const Wing* partner = nullptr;
  for (const Wing& wing : wings)
    if (!wing.forward && (!partner || turn(wing) < turn(*partner))) partner = &wing;
  return *partner;
}

/// One pass over the edges; a triangle is changed once at most. Whether there was anything to do.
bool separateSome(TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k)
    for (int i = 0; i < 3; ++i)
      edges[std::minmax({mesh.triangles[k][i], mesh.triangles[k][(i + 1) % 3]})].push_back(k);
  std::vector<bool> touched(mesh.triangles.size(), false);
  bool found = false;
  for (const auto& [edge, around] : edges) {
    if (around.size() <= 2) continue;
    found = true;
    if (std::any_of(around.begin(), around.end(), [&](std::uint32_t k) { return touched[k]; })) continue;
    for (std::uint32_t k : around) touched[k] = true;
    const std::vector<Wing> wings = wingsOf(mesh, edge.first, edge.second, around);
    const Wing& forward = *std::find_if(wings.begin(), wings.end(), [](const Wing& w) { return w.forward; });
    splitEdge(mesh, edge.first, edge.second, forward.triangle, partnerOf(forward, wings).triangle);
  }
  return found;
}

}  // namespace

void separateSheets(TriangleMesh& mesh) {
  while (separateSome(mesh)) {
  }
}

}  // namespace vasa::human
