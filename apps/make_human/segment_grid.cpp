#include "make_human/segment_grid.h"

#include <algorithm>
#include <cmath>

#include "math/closest_point.h"

namespace vasa::human {

namespace {

constexpr int kBlockBits = 3;  // a block: 8 x 8 x 8 cells

}  // namespace

SegmentGrid::Cell SegmentGrid::cellAt(vec3 p) const {
  return Cell(glm::floor(p / cell_)) + std::int64_t(1 << 20);
}

// All that may hold something, by x, then y, then z.
template <class Visit>
void SegmentGrid::visitCells(Cell low, Cell high, Visit visit) const {
  const Cell first = low >> std::int64_t(kBlockBits),
             blocks = (high >> std::int64_t(kBlockBits)) - first + std::int64_t(1);
  occupied_.clear();
  for (std::int64_t x = 0; x < blocks.x; ++x)
    for (std::int64_t y = 0; y < blocks.y; ++y)
      for (std::int64_t z = 0; z < blocks.z; ++z)
        occupied_.push_back(blocks_.contains(keyOf(first + Cell(x, y, z))));
  for (std::int64_t x = low.x; x <= high.x; ++x)
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      const std::int64_t row =
          (((x >> kBlockBits) - first.x) * blocks.y + (y >> kBlockBits) - first.y) * blocks.z;
      for (std::int64_t z = low.z; z <= high.z; ++z) {
        if (occupied_[std::size_t(row + (z >> kBlockBits) - first.z)])
          visit(keyOf({x, y, z}));
        else
          z |= (1 << kBlockBits) - 1;
      }
    }
}

void SegmentGrid::add(const Segment& segment) {
  const std::uint32_t number = std::uint32_t(segments_.size());
  segments_.push_back(segment);
  stamp_.push_back(0);
  const Cell low = cellAt(glm::min(segment.a, segment.b) - segment.radius),
             high = cellAt(glm::max(segment.a, segment.b) + segment.radius);
  for (std::int64_t x = low.x; x <= high.x; ++x)
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t z = low.z; z <= high.z; ++z) {
        cells_[keyOf({x, y, z})].push_back(number);
        blocks_.insert(keyOf(Cell(x, y, z) >> std::int64_t(kBlockBits)));
      }
}

const std::vector<std::uint32_t>& SegmentGrid::near(vec3 a, vec3 b, float reach) const {
  found_.clear();
  ++round_;
  visitCells(cellAt(glm::min(a, b) - reach), cellAt(glm::max(a, b) + reach), [&](Key key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (std::uint32_t number : cell->second) {
      if (stamp_[number] == round_) continue;
      stamp_[number] = round_;
      found_.push_back(number);
    }
  });
  return found_;
}

SegmentGrid::Nearest SegmentGrid::nearest(vec3 p, float within) const {
  Nearest best;
  for (float reach = std::min(cell_, within);; reach = std::min(2 * reach, within)) {
    best.distance = reach;
    for (std::uint32_t number : near(p, p, reach)) {
      const Segment& s = segments_[number];
      const float t = closestOnSegment(p, s.a, s.b), distance = glm::distance(p, glm::mix(s.a, s.b, t));
      if (distance < best.distance) best = {number, t, distance};
    }
    if (best.segment != kNone || reach >= within) return best;
  }
}

}  // namespace vasa::human
