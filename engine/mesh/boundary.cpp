#include "mesh/boundary.h"

#include <algorithm>

namespace vasa {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Border edges at each vertex.
struct BorderGraph {
  std::vector<std::uint32_t> first, edges;
  explicit BorderGraph(const TriangleMesh& mesh, const MeshEdges& all) : first(mesh.positions.size() + 1, 0) {
    for (std::uint32_t e = 0; e < all.size(); ++e)
      if (all.trianglesOf(e).size() == 1) ++first[all.vertices[e].x + 1], ++first[all.vertices[e].y + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    edges.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t e = 0; e < all.size(); ++e)
      if (all.trianglesOf(e).size() == 1)
        for (int k = 0; k < 2; ++k) edges[next[all.vertices[e][k]]++] = e;
  }
};

}  // namespace

std::vector<BoundaryLoop> boundaryLoops(const TriangleMesh& mesh, const MeshEdges& edges) {
  const BorderGraph graph(mesh, edges);
  std::vector<BoundaryLoop> loops;
  std::vector<bool> used(edges.size(), false);
  std::vector<std::uint32_t> placeInPath(mesh.positions.size(), kNone);
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for (std::uint32_t seed = 0; seed < mesh.positions.size(); ++seed) {
    // Walk until stuck; whenever the walk meets itself, the part since then is a loop and leaves the path.
    std::vector<std::uint32_t> path{seed}, pathEdges;
    placeInPath[seed] = 0;
    while (!path.empty()) {
      const std::uint32_t at = path.back();
      while (next[at] < graph.first[at + 1] && used[graph.edges[next[at]]]) ++next[at];
      if (next[at] == graph.first[at + 1]) {  // a dead end
        placeInPath[at] = kNone;
        path.pop_back();
        if (!pathEdges.empty()) pathEdges.pop_back();
        continue;
      }
      const std::uint32_t edge = graph.edges[next[at]];
      used[edge] = true;
      const std::uint32_t to = edges.vertices[edge].x == at ? edges.vertices[edge].y : edges.vertices[edge].x;
      pathEdges.push_back(edge);
      if (placeInPath[to] == kNone) {
        placeInPath[to] = std::uint32_t(path.size());
        path.push_back(to);
        continue;
      }
      const std::uint32_t from = placeInPath[to];
      BoundaryLoop loop;
      loop.vertices.assign(path.begin() + from, path.end());
      loop.edges.assign(pathEdges.begin() + from, pathEdges.end());
      for (std::size_t i = from + 1; i < path.size(); ++i) placeInPath[path[i]] = kNone;
      path.resize(from + 1);
      pathEdges.resize(from);
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

TriangleMesh fillLoops(const TriangleMesh& mesh, const MeshEdges& edges,
                       std::span<const BoundaryLoop> loops) {
  TriangleMesh filled = mesh;
  for (const BoundaryLoop& loop : loops) {
    const std::size_t count = loop.vertices.size();
    if (count < 3) continue;
    dvec3 sum(0);
    for (const std::uint32_t v : loop.vertices) sum += dvec3(mesh.positions[v]);
    const auto apex = std::uint32_t(filled.positions.size());
    if (count > 3) filled.positions.push_back(vec3(sum / double(count)));
    for (std::size_t i = 0; i < (count > 3 ? count : 1); ++i) {
      std::uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % count];
      const uvec3& t = mesh.triangles[edges.trianglesOf(loop.edges[i])[0]];
      for (int k = 0; k < 3; ++k)
        if (t[k] == a && t[(k + 1) % 3] == b) {  // the neighbour runs a → b, so the patch runs b → a
          std::swap(a, b);
          break;
        }
      if (count > 3) {
        filled.triangles.push_back({a, b, apex});
        continue;
      }
      for (const std::uint32_t c : loop.vertices)
        if (c != a && c != b) filled.triangles.push_back({a, b, c});
    }
  }
  return filled;
}

}  // namespace vasa
