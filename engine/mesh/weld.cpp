#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

using Cell = std::array<std::int64_t, 3>;
struct CellHash {
  std::size_t operator()(const Cell& c) const noexcept {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const std::int64_t v : c) h = (h ^ std::uint64_t(v)) * 0xff51afd7ed558ccdull, h ^= h >> 29;
    return std::size_t(h);
  }
};

class Welder {
 public:
  Welder(float tolerance, std::size_t expected) : tolerance_(tolerance) { cells_.reserve(expected); }

  std::uint32_t add(vec3 position) {
    const Cell cell = cellOf(position);
    const int reach = tolerance_ > 0 ? 1 : 0;
    for (int dx = -reach; dx <= reach; ++dx)
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dz = -reach; dz <= reach; ++dz) {
          const auto found = cells_.find({cell[0] + dx, cell[1] + dy, cell[2] + dz});
          if (found == cells_.end()) continue;
          for (std::uint32_t i = found->second.first; i != kNone; i = next_[i])
            if (glm::distance(positions_[i], position) <= tolerance_) return i;
        }
    const std::uint32_t own = std::uint32_t(positions_.size());
    positions_.push_back(position);
    next_.push_back(kNone);
    const auto [at, fresh] = cells_.try_emplace(cell, own, own);
    if (!fresh) at->second.second = next_[at->second.second] = own;
    return own;
  }
  std::vector<vec3> take() { return std::move(positions_); }

 private:
  Cell cellOf(vec3 p) const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      const float value = p[axis] + 0.0f;  // -0 and 0 are one place
      std::int32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      // A far-off vertex must not overflow the cell number; there neighbours are further apart than any cell.
      cell[std::size_t(axis)] =
          tolerance_ > 0 ? std::int64_t(std::clamp(std::floor(double(value) / tolerance_), -9e17, 9e17))
                         : bits;
    }
    return cell;
  }
  float tolerance_;
  std::vector<vec3> positions_;
  std::vector<std::uint32_t> next_;  // the cell's next position
  std::unordered_map<Cell, std::pair<std::uint32_t, std::uint32_t>, CellHash> cells_;  // first and last
};

bool finite(vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

TriangleMesh weld(const TriangleMesh& mesh, float tolerance) {
  Welder welder(std::max(tolerance, 0.0f), mesh.positions.size());
  std::vector<std::uint32_t> welded(mesh.positions.size(), kNone);
  std::unordered_set<Cell, CellHash> seen;
  seen.reserve(mesh.triangles.size());
  TriangleMesh result;
  Checkpoints checkpoints;
  for (const uvec3& t : mesh.triangles) {
    checkpoints.pass();
    bool usable = true;
    for (int k = 0; k < 3; ++k)
      usable = usable && t[k] < mesh.positions.size() && finite(mesh.positions[t[k]]);
    if (!usable) continue;
    uvec3 corner;
    for (int k = 0; k < 3; ++k) {
      if (welded[t[k]] == kNone) welded[t[k]] = welder.add(mesh.positions[t[k]]);
      corner[k] = welded[t[k]];
    }
    if (corner.x == corner.y || corner.y == corner.z || corner.z == corner.x) continue;
    Cell key{corner.x, corner.y, corner.z};
    std::sort(key.begin(), key.end());
    if (seen.insert(key).second) result.triangles.push_back(corner);
  }
  // Vertices whose every triangle collapsed are left over; renumber what is used, in order.
  const std::vector<vec3> positions = welder.take();
  std::vector<std::uint32_t> number(positions.size(), kNone);
  for (const uvec3& t : result.triangles)
    for (int k = 0; k < 3; ++k) number[t[k]] = 0;
  checkpoint();
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    if (number[i] != kNone) {
      number[i] = std::uint32_t(result.positions.size());
      result.positions.push_back(positions[i]);
    }
  for (uvec3& t : result.triangles) t = {number[t.x], number[t.y], number[t.z]};
  return result;
}

}  // namespace vasa
