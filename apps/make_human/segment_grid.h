#pragma once
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/ids.h"
#include "math/types.h"

namespace vasa::human {

/// Round pieces of vessels in a grid of cells: which lie near a place. Grows piece by piece. Blocks of cells
/// in which there is nothing are passed over, so that cells may be small beside what is looked for.
class SegmentGrid {
 public:
  struct Segment {
    vec3 a{0}, b{0};
    float radius = 0;         ///< [m] the larger of its ends'
    std::uint32_t owner = 0;  ///< of the caller's choice: a vessel's number
    float at = 0;             ///< of the caller's choice: where on the vessel it begins
  };

  /// @param cell  [m] about the length of the longest segments
  explicit SegmentGrid(float cell) : cell_(cell) {}

  void add(const Segment& segment);
  const std::vector<Segment>& segments() const { return segments_; }

  /// Numbers of all segments whose boxes come within `reach` of the box around a and b; each once, the order
  /// depends only on what was added. Valid until the next call.
  const std::vector<std::uint32_t>& near(vec3 a, vec3 b, float reach) const;

  struct Nearest {
    std::uint32_t segment = kNone;  ///< none within the distance asked for
    float t = 0;                    ///< on the segment
    float distance = 0;             ///< [m] to its centre line
  };
  Nearest nearest(vec3 p, float within) const;

 private:
  using Key = std::uint64_t;
  using Cell = glm::i64vec3;
  static Key keyOf(Cell cell) { return Key(cell.x) << 42 | Key(cell.y) << 21 | Key(cell.z); }
  Cell cellAt(vec3 p) const;
  template <class Visit>
  void visitCells(Cell low, Cell high, Visit visit) const;

  float cell_;
  std::vector<Segment> segments_;
  std::unordered_map<Key, std::vector<std::uint32_t>> cells_;
  std::unordered_set<Key> blocks_;
  mutable std::vector<char> occupied_;  // the blocks of a visit
  mutable std::vector<std::uint32_t> found_, stamp_;
  mutable std::uint32_t round_ = 0;
};

}  // namespace vasa::human
