#include "mesh/slice.h"

#include <algorithm>
#include <cmath>

#include "core/cancellation.h"

namespace vasa {
namespace {

// A piece of the cut inside one triangle, between two of the mesh's edges.
struct Piece {
  std::uint32_t edge[2];
};
struct PieceEnd {
  std::uint32_t edge, piece;
  bool operator<(const PieceEnd& other) const {
    return edge != other.edge ? edge < other.edge : piece < other.piece;
  }
};

// Area against that of the circle with the same outline: 1 for a circle, 0 for a strip.
constexpr float kStrip = 0.35f;
float roundness(const SectionShape& shape) {
  const float circle = (shape.perimeter + shape.chord) / (2 * kPi);
  return circle > 0 ? shape.radius * shape.radius / (circle * circle) : 0;
}

// Convex hull in the plane of all contour points within `reach` (Andrew 1979, monotone chain).
Contour hullOf(const std::vector<Contour>& contours, vec3 onPlane, vec3 normal, float reach) {
  const vec3 u = anyPerpendicular(normal), v = glm::cross(normal, u);
  std::vector<vec2> flat;
  for (const Contour& contour : contours)
    for (const vec3& p : contour.points)
      if (glm::distance(p, onPlane) < reach)
        flat.push_back({glm::dot(p - onPlane, u), glm::dot(p - onPlane, v)});
  std::sort(flat.begin(), flat.end(), [](vec2 a, vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const vec2 p : flat) {
      const auto right = [&] {
        const vec2 a = hull[hull.size() - 2], b = hull.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (hull.size() >= base + 2 && right()) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(flat.begin(), flat.end());
  }
  Contour contour;
  contour.closed = true;
  for (const vec2 p : hull) contour.points.push_back(onPlane + p.x * u + p.y * v);
  return contour;
}

}  // namespace

const std::vector<Contour>& Slicer::cut(vec3 onPlane, vec3 normal, float reach) {
  checkpoint();
  contours_.clear();
  candidates_.clear();
  tree_.nearPlane(onPlane, normal, reach, candidates_);
  met_ += candidates_.size();
  // A vertex on the plane counts as above it, the same for every triangle around it: no special cases.
  const auto height = [&](std::uint32_t v) { return glm::dot(mesh_.positions[v] - onPlane, normal); };
  std::vector<Piece> pieces;
  std::vector<PieceEnd> ends;
  for (const std::uint32_t t : candidates_) {
    const uvec3& c = mesh_.triangles[t];
    const bool above[3] = {height(c.x) >= 0, height(c.y) >= 0, height(c.z) >= 0};
    Piece piece{};
    int found = 0;
    for (int k = 0; k < 3; ++k)
      if (above[k] != above[(k + 1) % 3]) piece.edge[found++] = edges_.ofTriangle[t][k];
    if (found != 2) continue;
    for (const std::uint32_t e : piece.edge) ends.push_back({e, std::uint32_t(pieces.size())});
    pieces.push_back(piece);
  }
  std::sort(ends.begin(), ends.end());
  std::vector<bool> used(pieces.size(), false);
  const auto follow = [&](std::uint32_t edge) {
    for (auto it = std::lower_bound(ends.begin(), ends.end(), PieceEnd{edge, 0});
         it != ends.end() && it->edge == edge; ++it)
      if (!used[it->piece]) return std::int64_t(it->piece);
    return std::int64_t(-1);
  };
  const auto crossing = [&](std::uint32_t edge) {
    const uvec2 v = edges_.vertices[edge];
    const float a = height(v.x), b = height(v.y);
    return glm::mix(mesh_.positions[v.x], mesh_.positions[v.y],
                    a == b ? 0.5f : std::clamp(a / (a - b), 0.0f, 1.0f));
  };
  for (std::uint32_t seed = 0; seed < pieces.size(); ++seed) {
    if (used[seed]) continue;
    used[seed] = true;
    std::vector<std::uint32_t> chain{pieces[seed].edge[0], pieces[seed].edge[1]};
    bool closed = false;
    for (int side = 0; side < 2 && !closed; ++side) {
      for (std::int64_t next; (next = follow(chain.back())) >= 0;) {
        used[std::size_t(next)] = true;
        const Piece& piece = pieces[std::size_t(next)];
        const std::uint32_t to = piece.edge[0] == chain.back() ? piece.edge[1] : piece.edge[0];
        if (to == chain.front()) {
          closed = true;
          break;
        }
        chain.push_back(to);
      }
      if (!closed) std::reverse(chain.begin(), chain.end());
    }
    Contour& contour = contours_.emplace_back();
    contour.closed = closed;
    for (const std::uint32_t e : chain) contour.points.push_back(crossing(e));
  }
  return contours_;
}

SectionShape shapeOf(const Contour& contour, vec3 onPlane, vec3 normal) {
  const vec3 u = anyPerpendicular(normal), v = glm::cross(normal, u);
  const std::size_t n = contour.points.size();
  std::vector<vec2> flat(n);
  for (std::size_t i = 0; i < n; ++i) {
    const vec3 d = contour.points[i] - onPlane;
    flat[i] = {glm::dot(d, u), glm::dot(d, v)};
  }
  SectionShape shape;
  double area = 0;
  double cx = 0, cy = 0;
  vec2 mean(0);
  for (std::size_t i = 0; i < n; ++i) {
    const vec2 a = flat[i], b = flat[(i + 1) % n];
    mean += a / float(n);
    const double cross = double(a.x) * b.y - double(b.x) * a.y;
    area += 0.5 * cross;
    cx += cross * (double(a.x) + b.x);
    cy += cross * (double(a.y) + b.y);
    (i + 1 < n || contour.closed ? shape.perimeter : shape.chord) += glm::distance(a, b);
    // The ray from the plane's point along +x.
    if ((a.y > 0) != (b.y > 0) && (a.x - b.x) * a.y / (b.y - a.y) + a.x > 0) shape.contains = !shape.contains;
  }
  const double scale = double(shape.perimeter) * shape.perimeter;
  const vec2 centre = std::abs(area) > 1e-6 * scale ? vec2(cx / (6 * area), cy / (6 * area)) : mean;
  shape.centre = onPlane + centre.x * u + centre.y * v;
  shape.radius = float(std::sqrt(std::abs(area) / kPi));
  shape.nearest = std::numeric_limits<float>::infinity();
  for (const vec2 p : flat) {
    const float distance = glm::distance(p, centre);
    shape.nearest = std::min(shape.nearest, distance);
    shape.farthest = std::max(shape.farthest, distance);
  }
  return shape;
}

std::optional<SectionShape> Slicer::section(vec3 onPlane, vec3 normal, float reach) {
  if (met_ > kMostCuts * std::max(mesh_.triangles.size(), kFewTriangles)) return std::nullopt;
  std::optional<SectionShape> best;
  const auto better = [&](const SectionShape& shape) {
    if (!best) return true;
    if (shape.contains != best->contains) return shape.contains;
    if (shape.contains) return shape.radius < best->radius;
    return glm::distance(shape.centre, onPlane) < glm::distance(best->centre, onPlane);
  };
  for (const Contour& contour : cut(onPlane, normal, reach)) {
    if (contour.points.size() < 3) continue;
    const SectionShape shape = shapeOf(contour, onPlane, normal);
    if (!(shape.radius > 0) || shape.chord > 0.4f * (shape.perimeter + shape.chord)) continue;
    if (!shape.contains && glm::distance(shape.centre, onPlane) > 0.5f * reach) continue;
    if (better(shape)) best = shape;
  }
  if (best && roundness(*best) > kStrip) return best;
  const Contour hull = hullOf(contours_, onPlane, normal, 0.5f * reach);
  if (hull.points.size() < 3) return best;
  const SectionShape shape = shapeOf(hull, onPlane, normal);
  return !best || roundness(shape) > roundness(*best) ? shape : best;
}

}  // namespace vasa
