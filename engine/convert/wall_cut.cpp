#include "convert/wall_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/ids.h"
#include "mesh/edges.h"

namespace vasa {
namespace {

// Around the openings: what is cut out does not go beyond.
constexpr float kReachRadii = 4;
// Of a contour from the axis, in radii of the opening.
constexpr float kNearestContour = 0.45f, kFarthestContour = 2.0f;

using Edge = std::pair<std::uint32_t, std::uint32_t>;
Edge edgeOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct Contour {
  std::vector<std::uint32_t> edges;      // that it crosses
  std::vector<std::uint32_t> triangles;  // triangles[k] leads from edges[k] to the next
};

class Cutter {
 public:
  Cutter(const TriangleMesh& surface, std::span<const WallOpening> openings) : openings_(openings) {
    for (const WallOpening& o : openings) centre_ += o.centre / float(openings.size());
    for (const WallOpening& o : openings)
      reach_ = std::max(reach_, glm::distance(o.centre, centre_) + kReachRadii * o.radius);
    Aabb near;
    near.add(centre_, reach_);
    std::vector<std::uint32_t> number(surface.positions.size(), kNone);
    for (uvec3 t : surface.triangles) {
      Aabb box;
      for (int k = 0; k < 3; ++k) box.add(surface.positions[t[k]]);
      if (!box.overlaps(near)) continue;
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& n = number[t[k]];
        if (n == kNone)
          n = std::uint32_t(mesh_.positions.size()), mesh_.positions.push_back(surface.positions[t[k]]);
        t[k] = n;
      }
      mesh_.triangles.push_back(t);
    }
  }

  WallPiece run() {
    for (const WallOpening& opening : openings_)
      if (const WallFault fault = cut(opening); fault != WallFault::none) return {fault, {}, {}};
    if (const WallFault fault = gather(); fault != WallFault::none) return {fault, {}, {}};
    return piece();
  }

 private:
  // Distance of a vertex beyond the plane; never 0. All that asks for a side asks here: so all agree on
  // vertices beside it.
  float sideOf(const WallOpening& opening, std::uint32_t vertex) const {
    const float least = 1e-4f * opening.radius,
                side = glm::dot(mesh_.positions[vertex] - opening.centre, opening.outward);
    return std::abs(side) < least ? least : side;
  }
  std::vector<float> sidesOf(const WallOpening& opening) const {
    std::vector<float> sides;
    for (std::uint32_t v = 0; v < mesh_.positions.size(); ++v) sides.push_back(sideOf(opening, v));
    return sides;
  }
  static std::uint32_t third(const uvec3& triangle, const uvec2& edge) {
    for (int k = 0; k < 3; ++k)
      if (triangle[k] != edge.x && triangle[k] != edge.y) return triangle[k];
    return triangle.x;
  }

  // From an edge on through triangles; open where it comes to a border.
  static bool follow(const MeshEdges& edges, const std::vector<bool>& crossed, std::uint32_t start,
                     Contour& contour) {
    std::uint32_t edge = start, triangle = edges.trianglesOf(start)[0];
    do {
      if (edges.trianglesOf(edge).size() != 2) return false;
      contour.edges.push_back(edge);
      contour.triangles.push_back(triangle);
      const uvec3& sides = edges.ofTriangle[triangle];
      std::uint32_t next = kNone;
      for (int k = 0; k < 3; ++k)
        if (sides[k] != edge && crossed[sides[k]]) next = sides[k];
      if (next == kNone || contour.edges.size() > edges.size()) return false;
      const auto both = edges.trianglesOf(next);
      if (both.size() != 2) return false;
      triangle = both[0] == triangle ? both[1] : both[0];
      edge = next;
    } while (edge != start);
    return true;
  }

  WallFault cut(const WallOpening& opening) {
    const std::vector<float> sides = sidesOf(opening);
    const MeshEdges edges = buildEdges(mesh_);
    std::vector<bool> crossed(edges.size()), seen(edges.size());
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      crossed[e] = (sides[edges.vertices[e].x] < 0) != (sides[edges.vertices[e].y] < 0);
    const auto place = [&](std::uint32_t e) {
      const auto [a, b] = std::pair(edges.vertices[e].x, edges.vertices[e].y);
      return glm::mix(mesh_.positions[a], mesh_.positions[b], sides[a] / (sides[a] - sides[b]));
    };
    Contour best;
    float least = std::numeric_limits<float>::infinity();
    bool turned = false;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      if (!crossed[e] || seen[e]) continue;
      Contour contour;
      const bool closed = follow(edges, crossed, e, contour);
      for (const std::uint32_t passed : contour.edges) seen[passed] = true;
      if (!closed) continue;
      float turn = 0, area = 0, nearest = 1e30f, farthest = 0;
      for (std::size_t k = 0; k < contour.edges.size(); ++k) {
        const vec3 a = place(contour.edges[k]) - opening.centre;
        const vec3 b = place(contour.edges[(k + 1) % contour.edges.size()]) - opening.centre;
        const float cross = glm::dot(glm::cross(a, b), opening.outward);
        turn += std::atan2(cross, glm::dot(a, b));
        area += cross / 2;
        nearest = std::min(nearest, glm::length(a)), farthest = std::max(farthest, glm::length(a));
      }
      if (std::abs(turn) < kPi || nearest < kNearestContour * opening.radius ||
          farthest > kFarthestContour * opening.radius)
        continue;
      if (std::abs(area) < least) least = std::abs(area), best = std::move(contour), turned = area < 0;
    }
    if (best.edges.empty()) return WallFault::noWall;
    for (const std::uint32_t e : best.edges)
      if (barrier_.contains(edgeOf(edges.vertices[e].x, edges.vertices[e].y))) return WallFault::crowded;
    split(best, edges, sides, place, turned);
    return WallFault::none;
  }

  template <class Place>
  void split(const Contour& contour, const MeshEdges& edges, const std::vector<float>& sides,
             const Place& place, bool turned) {
    std::map<std::uint32_t, std::uint32_t> vertexOn;
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t e : contour.edges) {
      vertexOn[e] = std::uint32_t(mesh_.positions.size());
      loop.push_back(vertexOn[e]);
      mesh_.positions.push_back(place(e));
    }
    for (const std::uint32_t index : contour.triangles) {
      const uvec3 t = mesh_.triangles[index], on = edges.ofTriangle[index];
      int apex = 0;
      while ((sides[t[apex]] < 0) == (sides[t[(apex + 1) % 3]] < 0) ||
             (sides[t[apex]] < 0) == (sides[t[(apex + 2) % 3]] < 0))
        ++apex;
      const std::uint32_t a = t[apex], b = t[(apex + 1) % 3], c = t[(apex + 2) % 3];
      const std::uint32_t ab = vertexOn[on[apex]], ca = vertexOn[on[(apex + 2) % 3]];
      mesh_.triangles[index] = {a, ab, ca};
      mesh_.triangles.push_back({ab, b, c});
      mesh_.triangles.push_back({ab, c, ca});
    }
    if (turned) std::reverse(loop.begin(), loop.end());
    for (std::size_t k = 0; k < loop.size(); ++k)
      barrier_.insert(edgeOf(loop[k], loop[(k + 1) % loop.size()]));
    loops_.push_back(std::move(loop));
  }

  // The triangles of a loop's edges on the inner side of its plane.
  std::vector<std::uint32_t> innerOf(std::size_t loop, const MeshEdges& edges) const {
    const WallOpening& opening = openings_[loop];
    std::vector<std::uint32_t> inner;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const uvec2 v = edges.vertices[e];
      if (!barrier_.contains({v.x, v.y}) || !onLoop(loop, v.x) || !onLoop(loop, v.y)) continue;
      for (const std::uint32_t t : edges.trianglesOf(e))
        if (sideOf(opening, third(mesh_.triangles[t], v)) < 0) inner.push_back(t);
    }
    return inner;
  }
  bool onLoop(std::size_t loop, std::uint32_t vertex) const {
    return std::ranges::find(loops_[loop], vertex) != loops_[loop].end();
  }

  // The triangles that hang together between the loops.
  WallFault gather() {
    const MeshEdges edges = buildEdges(mesh_);
    inside_.assign(mesh_.triangles.size(), false);
    std::vector<std::uint32_t> queue = innerOf(0, edges);
    for (const std::uint32_t t : queue) inside_[t] = true;
    while (!queue.empty()) {
      const std::uint32_t t = queue.back();
      queue.pop_back();
      for (int k = 0; k < 3; ++k) {
        if (glm::distance(mesh_.positions[mesh_.triangles[t][k]], centre_) > reach_) return WallFault::open;
        const std::uint32_t e = edges.ofTriangle[t][k];
        if (barrier_.contains({edges.vertices[e].x, edges.vertices[e].y})) continue;
        if (edges.trianglesOf(e).size() != 2) return WallFault::torn;
        for (const std::uint32_t other : edges.trianglesOf(e))
          if (!inside_[other]) inside_[other] = true, queue.push_back(other);
      }
    }
    std::size_t border = 0, walls = 0;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const auto both = edges.trianglesOf(e);
      const auto within = std::ranges::count_if(both, [&](std::uint32_t t) { return inside_[t]; });
      walls += within > 0;
      if (!barrier_.contains({edges.vertices[e].x, edges.vertices[e].y})) continue;
      if (within == 2) return WallFault::open;  // it goes on behind an opening
      border += within;
    }
    for (std::size_t loop = 1; loop < loops_.size(); ++loop)
      for (const std::uint32_t t : innerOf(loop, edges))
        if (!inside_[t]) return WallFault::apart;
    std::set<std::uint32_t> vertices;
    std::size_t faces = 0;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (inside_[t])
        ++faces, vertices.insert({mesh_.triangles[t].x, mesh_.triangles[t].y, mesh_.triangles[t].z});
    const auto euler = std::ptrdiff_t(vertices.size() + faces) - std::ptrdiff_t(walls);
    if (border != barrier_.size() || euler != 2 - std::ptrdiff_t(loops_.size())) return WallFault::open;
    return WallFault::none;
  }

  WallPiece piece() const {
    WallPiece piece{WallFault::none, {}, {}};
    std::vector<std::uint32_t> number(mesh_.positions.size(), kNone);
    const auto numbered = [&](std::uint32_t v) {
      if (number[v] == kNone)
        number[v] = std::uint32_t(piece.mesh.positions.size()),
        piece.mesh.positions.push_back(mesh_.positions[v]);
      return number[v];
    };
    for (const auto& loop : loops_) {
      for (const std::uint32_t v : loop) numbered(v);
      piece.loops.push_back(std::uint32_t(loop.size()));
    }
    bool against = false;  // seen from outside a border runs clockwise
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!inside_[t]) continue;
      const uvec3 v = mesh_.triangles[t];
      piece.mesh.triangles.push_back({numbered(v.x), numbered(v.y), numbered(v.z)});
      const uvec3& added = piece.mesh.triangles.back();
      for (int k = 0; k < 3; ++k) against = against || (added[k] == 0 && added[(k + 1) % 3] == 1);
    }
    if (against)
      for (uvec3& t : piece.mesh.triangles) std::swap(t.y, t.z);
    return piece;
  }

  std::span<const WallOpening> openings_;
  vec3 centre_{0};
  float reach_ = 0;
  TriangleMesh mesh_;
  std::set<Edge> barrier_;
  std::vector<std::vector<std::uint32_t>> loops_;
  std::vector<bool> inside_;
};

}  // namespace

WallPiece cutWall(const TriangleMesh& surface, std::span<const WallOpening> openings) {
  return Cutter(surface, openings).run();
}

}  // namespace vasa
