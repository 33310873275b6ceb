#include "make_human/segment_grid.h"

#include <algorithm>
#include <cmath>

#include "math/closest_point.h"

namespace vasa::human {

template <class Visit>
void SegmentGrid::visitCells(vec3 low, vec3 high, Visit visit) const {
  const auto index = [&](float v) { return std::int64_t(std::floor(v / cell_)) + (1 << 20); };
  for (std::int64_t x = index(low.x); x <= index(high.x); ++x)
    for (std::int64_t y = index(low.y); y <= index(high.y); ++y)
      for (std::int64_t z = index(low.z); z <= index(high.z); ++z)
        visit(Key(x) << 42 | Key(y) << 21 | Key(z));
}

void SegmentGrid::add(const Segment& segment) {
  const std::uint32_t number = std::uint32_t(segments_.size());
  segments_.push_back(segment);
  stamp_.push_back(0);
  visitCells(glm::min(segment.a, segment.b) - segment.radius, glm::max(segment.a, segment.b) + segment.radius,
             [&](Key key) { cells_[key].push_back(number); });
}

const std::vector<std::uint32_t>& SegmentGrid::near(vec3 a, vec3 b, float reach) const {
  found_.clear();
  ++round_;
  visitCells(glm::min(a, b) - reach, glm::max(a, b) + reach, [&](Key key) {
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
    if (best.segment != 0xffffffffu || reach >= within) return best;
  }
}

}  // namespace vasa::human
