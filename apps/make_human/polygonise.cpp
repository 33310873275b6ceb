#include "make_human/polygonise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "make_human/separate_sheets.h"
#include "make_human/smooth_union.h"

// Every octree leaf that the surface crosses gets one vertex. Every shortest edge between leaves whose ends
// lie on different sides of the surface gives a polygon of the three or four leaves around it. Such polygons
// close across leaves of different size, whatever the size, because each edge is answered exactly once.
namespace vasa::human {
namespace {

constexpr int kLevels = 3;  // coarse leaves are 2^kLevels units wide
constexpr int kCoarse = 1 << kLevels;

using ivec3 = glm::ivec3;

std::uint64_t keyOf(ivec3 p, int extra = 0) {
  return (std::uint64_t(std::uint32_t(p.x)) << 44) | (std::uint64_t(std::uint32_t(p.y)) << 24) |
         (std::uint64_t(std::uint32_t(p.z)) << 8) | std::uint64_t(extra);
}

struct Leaf {
  ivec3 corner;
  int size;
  bool nearSurface;
  int vertex = -1;
};

class Contouring {
 public:
  Contouring(const ImplicitSurface& surface, float coarse) : surface_(surface), unit_(coarse / kCoarse) {
    const Aabb box = surface.bounds;
    cells_ = ivec3(glm::ceil((box.high - box.low) / coarse)) + 4;
    origin_ = box.low - coarse * vec3(1.43f, 1.37f, 1.61f);
    if (box.low.x >= 0 || box.high.x <= 0) return;
    // Odd multiples of half a cell keep the body's symmetry plane on cell faces.
    const float halfWidth = std::ceil((std::max(box.high.x, -box.low.x)) / coarse) + 2;
    cells_.x = int(2 * halfWidth);
    origin_.x = -halfWidth * coarse;
  }

  TriangleMesh run() {
    for (int z = 0; z < cells_.z; ++z)
      for (int y = 0; y < cells_.y; ++y)
        for (int x = 0; x < cells_.x; ++x) grow({ivec3(x, y, z) * kCoarse, kCoarse, true});
    for (std::size_t i = 0; i < leaves_.size(); ++i)
      if (leaves_[i].nearSurface) queue_.push_back(int(i));
    for (std::size_t k = 0; k < queue_.size(); ++k) contour(Leaf(leaves_[std::size_t(queue_[k])]));
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) mesh_.positions[i] /= float(crossings_[i]);
    return std::move(mesh_);
  }

 private:
  vec3 positionOf(ivec3 p) const { return origin_ + unit_ * vec3(p); }

  void grow(Leaf leaf) {
    const vec3 centre = origin_ + unit_ * (vec3(leaf.corner) + 0.5f * float(leaf.size));
    const float reach = 0.87f * unit_ * float(leaf.size);
    leaf.nearSurface = std::abs(surface_.distance(centre)) < surface_.certainty * reach;
    if (leaf.nearSurface && leaf.size > 1 &&
        surface_.cellSize(centre, reach) < 0.75f * unit_ * float(leaf.size)) {
      const int half = leaf.size / 2;
      for (int i = 0; i < 8; ++i) grow({leaf.corner + half * ivec3(i & 1, i >> 1 & 1, i >> 2), half, true});
      return;
    }
    index_.emplace(keyOf(leaf.corner, leaf.size), int(leaves_.size()));
    leaves_.push_back(leaf);
  }

  int leafAt(ivec3 p) const {
    for (int size = kCoarse; size > 0; size /= 2) {
      const auto found = index_.find(keyOf(p / size * size, size));
      if (found != index_.end()) return found->second;
    }
    return -1;
  }

  float valueAt(ivec3 p) {
    const auto [entry, fresh] = values_.emplace(keyOf(p), 0.0f);
    if (fresh) entry->second = surface_.distance(positionOf(p));
    return entry->second;
  }

  void contour(const Leaf& leaf) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 4; ++i) {
        ivec3 start = leaf.corner;
        start[(axis + 1) % 3] += i & 1 ? leaf.size : 0;
        start[(axis + 2) % 3] += i >> 1 ? leaf.size : 0;
        edge(start, axis, leaf.size);
      }
  }

  void edge(ivec3 start, int axis, int length) {
    ivec3 end = start;
    end[axis] += length;
    const float a = valueAt(start), b = valueAt(end);
    if ((a < 0) == (b < 0)) return;
    int around[4];
    for (int i = 0; i < 4; ++i) {
      ivec3 probe = start;  // quadrants in turn: (-,-) (+,-) (+,+) (-,+)
      probe[(axis + 1) % 3] -= i == 0 || i == 3 ? 1 : 0;
      probe[(axis + 2) % 3] -= i < 2 ? 1 : 0;
      around[i] = leafAt(probe);
      assert(around[i] >= 0);
    }
    bool shorter = false;  // a neighbour answers its own, shorter edges
    for (int index : around) {
      Leaf& neighbour = leaves_[std::size_t(index)];
      shorter = shorter || neighbour.size < length;
      if (neighbour.nearSurface) continue;
      neighbour.nearSurface = true;  // the distance was wrong by more than we thought
      queue_.push_back(index);
    }
    if (shorter) return;
    if (!done_.insert(keyOf(start, axis)).second) return;
    polygon(around, crossing(positionOf(start), positionOf(end), a, b), a < 0);
  }

  vec3 crossing(vec3 p, vec3 q, float a, float b) const {
    for (int step = 0; step < 3; ++step) {
      const vec3 middle = glm::mix(p, q, std::min(std::max(a / (a - b), 0.02f), 0.98f));
      const float value = surface_.distance(middle);
      if ((value < 0) == (a < 0))
        p = middle, a = value;
      else
        q = middle, b = value;
    }
    return glm::mix(p, q, a / (a - b));
  }

  std::uint32_t vertexOf(int leaf, vec3 point) {
    int& vertex = leaves_[std::size_t(leaf)].vertex;
    if (vertex < 0) {
      vertex = int(mesh_.positions.size());
      mesh_.positions.push_back(vec3(0));
      crossings_.push_back(0);
    }
    mesh_.positions[std::size_t(vertex)] += point;
    ++crossings_[std::size_t(vertex)];
    return std::uint32_t(vertex);
  }

  void polygon(const int (&around)[4], vec3 point, bool outwards) {
    std::vector<std::uint32_t> ring;
    for (int i = 0; i < 4; ++i)
      if (i == 0 || around[i] != around[i - 1]) ring.push_back(vertexOf(around[i], point));
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (!outwards) std::swap(ring.front(), ring[ring.size() == 4 ? 2 : 1]);
    if (ring.size() >= 3) mesh_.triangles.push_back({ring[0], ring[1], ring[2]});
    if (ring.size() == 4) mesh_.triangles.push_back({ring[0], ring[2], ring[3]});
  }

  const ImplicitSurface& surface_;
  float unit_;
  ivec3 cells_{0};
  vec3 origin_{0};
  std::vector<Leaf> leaves_;
  std::vector<int> queue_;  // leaves whose edges are to be looked at
  std::unordered_map<std::uint64_t, int> index_;
  std::unordered_map<std::uint64_t, float> values_;
  std::unordered_set<std::uint64_t> done_;
  TriangleMesh mesh_;
  std::vector<int> crossings_;
};

constexpr float kDifference = 3e-4f;  // [m] over which slopes are taken

vec3 ontoSurface(const ImplicitSurface& surface, vec3 p, float reach) {
  for (int step = 0; step < 2; ++step) {
    const vec3 slope = slopeOf(surface, p, kDifference);
    const float square = glm::dot(slope, slope);
    if (square < 1e-6f) return p;
    vec3 move = -surface.distance(p) / square * slope;
    const float length = glm::length(move);
    if (length > reach) move *= reach / length;
    p += move;
  }
  return p;
}

/// Moves each vertex halfway to its neighbours' mean, then back onto the surface.
void relax(TriangleMesh& mesh, const ImplicitSurface& surface) {
  std::vector<vec3> sums(mesh.positions.size(), vec3(0));
  std::vector<float> counts(mesh.positions.size(), 0);
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      sums[t[i]] += mesh.positions[t[(i + 1) % 3]] + mesh.positions[t[(i + 2) % 3]];
      counts[t[i]] += 2;
    }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const vec3 mean = sums[i] / counts[i];
    const float reach = glm::length(mean - mesh.positions[i]);
    mesh.positions[i] = ontoSurface(surface, glm::mix(mesh.positions[i], mean, 0.5f), 0.5f * reach + 5e-4f);
  }
}

}  // namespace

TriangleMesh polygonise(const ImplicitSurface& surface, float coarse) {
  TriangleMesh mesh = Contouring(surface, coarse).run();
  separateSheets(mesh);
  for (int round = 0; round < 3; ++round) relax(mesh, surface);
  return mesh;
}

}  // namespace vasa::human
