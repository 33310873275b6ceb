#include "make_human/solid.h"

#include <algorithm>
#include <cmath>

#include "math/closest_point.h"

// The ray runs along +z. Which side of a projected edge a point is on is computed for the edge's ends in a
// fixed order, so that the two triangles at an edge agree and none or both of their signs change.
namespace vasa::human {
namespace {

constexpr float kCell = 0.008f;
constexpr float kFarCell = 0.012f, kFarthestTold = 0.03f;  // [m] of the cells that tell at once what is far
constexpr float kUnknown = -1;
constexpr float kRounding = 1e-6f;  // [m] more than what rounding takes from a box around a point

double sideOf(const dvec3& a, const dvec3& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Whether p lies to the left of the edge from a to b, the same answer, negated, from b to a.
bool leftOf(std::uint32_t a, std::uint32_t b, const std::vector<vec3>& positions, double x, double y) {
  if (a < b) return sideOf(dvec3(positions[a]), dvec3(positions[b]), x, y) > 0;
  return !(sideOf(dvec3(positions[b]), dvec3(positions[a]), x, y) > 0);
}

/// Whether the ray through p misses the box around a triangle: most of a cell's are told so without a
/// product.
bool isBeside(vec3 a, vec3 b, vec3 c, vec3 p) {
  return (p.x < a.x && p.x < b.x && p.x < c.x) || (p.x > a.x && p.x > b.x && p.x > c.x) ||
         (p.y < a.y && p.y < b.y && p.y < c.y) || (p.y > a.y && p.y > b.y && p.y > c.y);
}

}  // namespace

Solid::Solid(const TriangleMesh& mesh) : mesh_(mesh), box_(mesh.bounds()) {
  const vec3 extent = box_.extent();
  columns_ = std::size_t(extent.x / kCell) + 1;
  rows_ = std::size_t(extent.y / kCell) + 1;
  first_.assign(columns_ * rows_ + 1, 0);
  const auto forCells = [&](std::uint32_t k, auto visit) {
    Aabb flat;
    for (int i = 0; i < 3; ++i) flat.add(mesh.positions[mesh.triangles[k][i]]);
    const std::size_t low = column(flat.low.x, flat.low.y), high = column(flat.high.x, flat.high.y);
    for (std::size_t y = low / columns_; y <= high / columns_; ++y)
      for (std::size_t x = low % columns_; x <= high % columns_; ++x) visit(y * columns_ + x);
  };
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k)
    forCells(k, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) first_[cell + 1] += first_[cell];
  triangles_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k)
    forCells(k, [&](std::size_t cell) { triangles_[next[cell]++] = k; });
}

const TriangleTree& Solid::tree() const {
  std::call_once(planted_, [this] { tree_ = std::make_unique<TriangleTree>(mesh_); });
  return *tree_;
}

std::size_t Solid::column(float x, float y) const {
  const auto clamped = [](float v, std::size_t count) {
    return std::size_t(std::clamp(v / kCell, 0.0f, float(count - 1)));
  };
  return clamped(y - box_.low.y, rows_) * columns_ + clamped(x - box_.low.x, columns_);
}

int Solid::winding(vec3 p) const {
  if (glm::any(glm::lessThan(p, box_.low)) || glm::any(glm::greaterThan(p, box_.high))) return 0;
  const std::size_t cell = column(p.x, p.y);
  const double x = p.x, y = p.y;
  int result = 0;
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
    const uvec3 t = mesh_.triangles[triangles_[k]];
    if (isBeside(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z], p)) continue;
    const bool ab = leftOf(t.x, t.y, mesh_.positions, x, y), bc = leftOf(t.y, t.z, mesh_.positions, x, y),
               ca = leftOf(t.z, t.x, mesh_.positions, x, y);
    if (ab != bc || bc != ca) continue;
    const dvec3 a(mesh_.positions[t.x]), b(mesh_.positions[t.y]), c(mesh_.positions[t.z]);
    const dvec3 normal = glm::cross(b - a, c - a);
    if (normal.z == 0) continue;
    const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
    if (z > double(p.z)) result += ab ? 1 : -1;
  }
  return result;
}

bool Solid::isDeep(vec3 p, float depth) const {
  if (winding(p) <= 0) return false;
  const float reach = depth + kRounding;
  const std::size_t low = column(p.x - reach, p.y - reach), high = column(p.x + reach, p.y + reach);
  for (std::size_t y = low / columns_; y <= high / columns_; ++y) {
    const std::size_t row = y * columns_;
    for (std::uint32_t k = first_[row + low % columns_]; k < first_[row + high % columns_ + 1]; ++k) {
      const uvec3& t = mesh_.triangles[triangles_[k]];
      const vec3 &a = mesh_.positions[t.x], &b = mesh_.positions[t.y], &c = mesh_.positions[t.z];
      if (std::max({a.z, b.z, c.z}) < p.z - reach || std::min({a.z, b.z, c.z}) > p.z + reach) continue;
      if (glm::distance(p, closestOnTriangle(p, a, b, c).point) < depth) return false;
    }
  }
  return true;
}

/// True only if p lies outside and farther than `within`: the middle of its coarse cell is farther by more
/// than p is from it. Threads that find the same cell unknown write the same number.
bool Solid::isFar(vec3 p, float within) const {
  const uvec3 counts = uvec3(box_.extent() / kFarCell) + 1u;
  std::call_once(cleared_, [&] {
    clear_ = std::vector<std::atomic<float>>(std::size_t(counts.x) * counts.y * counts.z);
    for (std::atomic<float>& cell : clear_) cell.store(kUnknown, std::memory_order_relaxed);
  });
  const vec3 at = glm::floor((p - box_.low) / kFarCell);
  if (glm::any(glm::lessThan(at, vec3(0))) || glm::any(glm::greaterThanEqual(at, vec3(counts)))) return false;
  const uvec3 cell(at);
  const vec3 middle = box_.low + (at + 0.5f) * kFarCell;
  std::atomic<float>& known = clear_[(std::size_t(cell.z) * counts.y + cell.y) * counts.x + cell.x];
  float clear = known.load(std::memory_order_relaxed);
  if (clear == kUnknown) {
    const TriangleTree::Nearest nearest = tree().nearest(middle, kFarthestTold);
    const float distance = nearest.triangle == kNone ? kFarthestTold : nearest.distance;
    clear = winding(middle) > 0 ? 0 : distance;
    known.store(clear, std::memory_order_relaxed);
  }
  return clear - 1e-5f > within + glm::distance(p, middle);
}

std::optional<Solid::Place> Solid::at(vec3 p, float within) const {
  if (isFar(p, within)) return std::nullopt;
  const TriangleTree::Nearest nearest = tree().nearest(p, within);
  const bool inside = winding(p) > 0;
  if (nearest.triangle == kNone) {
    if (!inside) return std::nullopt;
    return Place{-within, vec3(0)};
  }
  const vec3 away = inside ? nearest.point - p : p - nearest.point;
  if (nearest.distance > 1e-6f)
    return Place{inside ? -nearest.distance : nearest.distance, away / nearest.distance};
  const uvec3 t = mesh_.triangles[nearest.triangle];
  const vec3 a = mesh_.positions[t.x];
  return Place{0, glm::normalize(glm::cross(mesh_.positions[t.y] - a, mesh_.positions[t.z] - a))};
}

}  // namespace vasa::human
