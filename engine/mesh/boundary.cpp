#include "mesh/boundary.h"

#include <algorithm>
#include <queue>

#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

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
  Checkpoints checkpoints;
  for (std::uint32_t seed = 0; seed < mesh.positions.size(); ++seed) {
    checkpoints.pass();
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

namespace {

// A corner of the polygon that is still open, as a ring by `before` and `after`.
struct Corner {
  std::uint32_t vertex, before, after;
  bool open = true;
};

// Cuts ears off a polygon, always the one with the shortest cut: a slit closes like a zip.
void zip(const TriangleMesh& mesh, std::span<const std::uint32_t> polygon, std::vector<uvec3>& triangles) {
  const auto count = std::uint32_t(polygon.size());
  std::vector<Corner> ring(count);
  for (std::uint32_t i = 0; i < count; ++i)
    ring[i] = {polygon[i], (i + count - 1) % count, (i + 1) % count, true};
  struct Ear {
    float cut;
    std::uint32_t corner, before, after;
    bool operator>(const Ear& other) const {
      return cut != other.cut ? cut > other.cut : corner > other.corner;
    }
  };
  std::priority_queue<Ear, std::vector<Ear>, std::greater<>> ears;
  const auto offer = [&](std::uint32_t i) {
    const Corner& c = ring[i];
    const float cut =
        glm::distance(mesh.positions[ring[c.before].vertex], mesh.positions[ring[c.after].vertex]);
    ears.push({cut, i, c.before, c.after});
  };
  for (std::uint32_t i = 0; i < count; ++i) offer(i);
  Checkpoints checkpoints;
  for (std::uint32_t left = count; left >= 3;) {
    checkpoints.pass();
    const Ear ear = ears.top();
    ears.pop();
    Corner& c = ring[ear.corner];
    if (!c.open || c.before != ear.before || c.after != ear.after) continue;  // the ring has changed there
    triangles.push_back({ring[c.before].vertex, c.vertex, ring[c.after].vertex});
    c.open = false;
    ring[c.before].after = c.after;
    ring[c.after].before = c.before;
    if (--left < 3) break;
    offer(c.before);
    offer(c.after);
  }
}

}  // namespace

TriangleMesh fillLoops(const TriangleMesh& mesh, const MeshEdges& edges,
                       std::span<const BoundaryLoop> loops) {
  TriangleMesh filled = mesh;
  for (const BoundaryLoop& loop : loops) {
    if (loop.vertices.size() < 3) continue;
    std::vector<std::uint32_t> polygon = loop.vertices;
    // Against the direction of the triangles beside it, by the first edge's.
    const std::uint32_t a = polygon[0], b = polygon[1];
    const uvec3& t = mesh.triangles[edges.trianglesOf(loop.edges[0])[0]];
    for (int k = 0; k < 3; ++k)
      if (t[k] == a && t[(k + 1) % 3] == b) {
        std::reverse(polygon.begin(), polygon.end());
        break;
      }
    zip(mesh, polygon, filled.triangles);
  }
  return filled;
}

}  // namespace vasa
