#include "convert/joined_wall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr float kMostCells = 200000;
constexpr int kBlock = 4;       // cells: blocks far from any wall are not looked at more closely
constexpr float kSure = 0.3f;   // of the winding number from 1/2, there
constexpr float kClear = 1.2f;  // cells: a node this far from any wall has the next one on its side
// Of an edge: crossings stay this far from its ends, so that no triangle has no area.
constexpr float kAside = 0.06f;
constexpr int kSmoothings = 2;
using ivec3 = glm::ivec3;

// The six tetrahedra around a cell's diagonal: one for each order of the axes.
constexpr std::array<std::array<int, 3>, 6> kOrders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

class Field {
 public:
  Field(std::span<const LooseWall* const> walls, std::span<const Capsule> cores, const Aabb& box, float cell)
      : walls_(walls), cores_(cores), low_(box.low) {
    const vec3 extent = box.extent();
    cell_ = std::max(cell, std::cbrt(extent.x * extent.y * extent.z / kMostCells));
    count_ = ivec3(glm::ceil(extent / (cell_ * kBlock))) * kBlock + 1;
    values_.resize(std::size_t(count_.x) * std::size_t(count_.y) * std::size_t(count_.z), 1.0f);
    for (int z = 0; z < count_.z; z += kBlock)
      for (int y = 0; y < count_.y; y += kBlock)
        for (int x = 0; x < count_.x; x += kBlock) fill({x, y, z});
  }

  ivec3 count() const { return count_; }
  std::uint32_t number(ivec3 p) const { return std::uint32_t((p.z * count_.y + p.y) * count_.x + p.x); }
  vec3 place(ivec3 p) const { return low_ + cell_ * vec3(p); }
  float operator[](std::uint32_t node) const { return values_[node]; }

 private:
  float inside(vec3 p) const {
    float sum = 0;
    for (const LooseWall* wall : walls_) sum += wall->inside(p);
    return sum;
  }
  float distance(vec3 p, float within) const {
    for (const LooseWall* wall : walls_) within = std::min(within, wall->distance(p, within));
    return within;
  }

  float coreDistance(vec3 p) const {
    float least = std::numeric_limits<float>::infinity();
    for (const Capsule& core : cores_) {
      const vec3 nearest = glm::mix(core.a, core.b, closestOnSegment(p, core.a, core.b));
      least = std::min(least, glm::distance(p, nearest) - core.radius);
    }
    return least;
  }

  // The block's nodes up to, without, those of the next ones.
  void fill(ivec3 first) {
    const vec3 middle = place(first) + 0.5f * cell_ * float(kBlock - 1);
    const float reach = 0.9f * cell_ * float(kBlock);
    const float winding = inside(middle);
    const float core = coreDistance(middle);
    const bool far =
        distance(middle, 2 * reach) > 1.5f * reach && std::abs(winding - 0.5f) > kSure && core > 1.5f * reach;
    const ivec3 end = glm::min(first + kBlock, count_);
    for (int z = first.z; z < end.z; ++z)
      for (int y = first.y; y < end.y; ++y) {
        float around = winding;
        bool same = far;  // no wall, and no tear in one, lies before the next node
        for (int x = first.x; x < end.x; ++x) {
          const vec3 p = place({x, y, z});
          if (!same) around = inside(p);
          const float off = far ? reach : std::max(distance(p, reach), 1e-9f);
          const float wall = around > 0.5f ? -off : off;
          values_[number({x, y, z})] = far ? wall : std::min(wall, coreDistance(p));
          same = far || (off > kClear * cell_ && std::abs(around - 0.5f) > kSure);
        }
      }
  }

  std::span<const LooseWall* const> walls_;
  std::span<const Capsule> cores_;
  vec3 low_;
  float cell_ = 1;
  ivec3 count_{0};
  std::vector<float> values_;
};

class Polygoniser {
 public:
  explicit Polygoniser(const Field& field) : field_(field) {}

  TriangleMesh run() {
    const ivec3 cells = field_.count() - 1;
    for (int z = 0; z < cells.z; ++z)
      for (int y = 0; y < cells.y; ++y)
        for (int x = 0; x < cells.x; ++x)
          if (mixed({x, y, z}))
            for (const auto& order : kOrders) tetrahedron({x, y, z}, order);
    return std::move(mesh_);
  }

 private:
  struct Corner {
    std::uint32_t node;
    vec3 place;
    float value;
  };
  Corner cornerAt(ivec3 p) const {
    const std::uint32_t node = field_.number(p);
    return {node, field_.place(p), field_[node]};
  }

  bool mixed(ivec3 cell) const {
    int within = 0;
    for (int i = 0; i < 8; ++i) within += field_[field_.number(cell + ivec3(i & 1, i >> 1 & 1, i >> 2))] < 0;
    return within > 0 && within < 8;
  }

  std::uint32_t vertex(const Corner& a, const Corner& b) {
    const Corner &low = a.node < b.node ? a : b, &high = a.node < b.node ? b : a;
    const auto [found, fresh] =
        vertices_.emplace(std::uint64_t(low.node) << 32 | high.node, std::uint32_t(mesh_.positions.size()));
    if (fresh) {
      const float t = std::clamp(low.value / (low.value - high.value), kAside, 1 - kAside);
      mesh_.positions.push_back(glm::mix(low.place, high.place, t));
    }
    return found->second;
  }

  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, vec3 inside) {
    const vec3 &pa = mesh_.positions[a], &pb = mesh_.positions[b], &pc = mesh_.positions[c];
    const bool outward = glm::dot(glm::cross(pb - pa, pc - pa), pa - inside) > 0;
    mesh_.triangles.push_back(outward ? uvec3(a, b, c) : uvec3(a, c, b));
  }

  void tetrahedron(ivec3 cell, const std::array<int, 3>& order) {
    std::array<Corner, 4> in, out;
    std::size_t within = 0, outside = 0;
    const auto sort = [&](const Corner& corner) {
      (corner.value < 0 ? in[within++] : out[outside++]) = corner;
    };
    sort(cornerAt(cell));
    for (const int axis : order) {
      ++cell[axis];
      sort(cornerAt(cell));
    }
    if (within == 1) emit(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]), in[0].place);
    if (within == 3) emit(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]), in[0].place);
    if (within != 2) return;
    const std::uint32_t a = vertex(in[0], out[0]), b = vertex(in[0], out[1]), c = vertex(in[1], out[1]),
                        d = vertex(in[1], out[0]);
    const vec3 inside = 0.5f * (in[0].place + in[1].place);
    emit(a, b, c, inside);
    emit(a, c, d, inside);
  }

  const Field& field_;
  TriangleMesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
};

// Vertices move to their neighbours' mean: takes off the steps where a skin closes a tear, and where walls
// meet.
void smooth(TriangleMesh& mesh) {
  for (int round = 0; round < kSmoothings; ++round) {
    std::vector<vec4> sums(mesh.positions.size(), vec4(0));
    for (const uvec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        sums[t[k]] += vec4(mesh.positions[t[(k + 1) % 3]] + mesh.positions[t[(k + 2) % 3]], 2);
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (sums[i].w > 0) mesh.positions[i] = glm::mix(mesh.positions[i], vec3(sums[i]) / sums[i].w, 0.7f);
  }
}

}  // namespace

LooseWall::LooseWall(TriangleMesh mesh)
    : mesh_(std::move(mesh)), tree_(mesh_), winding_(mesh_.positions, mesh_.triangles) {}

TriangleMesh joinedWall(std::span<const LooseWall* const> walls, std::span<const Capsule> cores,
                        const Aabb& box, float cell) {
  TriangleMesh mesh = Polygoniser(Field(walls, cores, box, cell)).run();
  smooth(mesh);
  return mesh;
}

}  // namespace vasa
