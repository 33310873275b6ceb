#pragma once
#include <span>
#include <vector>

#include "core/large_pages.h"
#include "curve/bezier.h"

namespace vasa {

constexpr std::uint32_t kGroup = 8;  ///< children of a node, and lanes that are tested together

/// Eight boxes, one a lane. A lane without a box is empty: low = +inf, high = -inf.
struct alignas(64) BoxGroup {
  float low[3][kGroup];
  float high[3][kGroup];
};

/// A tube's chord capsule: start, radius (largest radius + deviation from the chord), chord.
struct alignas(32) ChordCapsule {
  float start[3];
  float radius;
  float chord[3];
  float unused;
};

/// What the kernels see of a BoxTree: raw arrays, because code compiled for one instruction set must not
/// instantiate inline library functions that the linker could then hand to all.
struct BoxTreeView {
  std::uint32_t tubeCount, levels;
  const std::uint32_t* tubes;
  const std::uint32_t* levelStart;
  BoxGroup* boxes;
  ChordCapsule* capsules;
  Bezier* shapes;
};

/// The fast detector's tree: topology fixed at rest and implicit (group g of a level holds the boxes of
/// groups 8g .. 8g+7 of the level below; groups of level 0 hold tubes), structure of arrays, no pointers.
/// Filled by the kernels (collide/kernels.h).
struct BoxTree {
  /// Order and topology from the tubes at rest; boxes are not filled yet.
  explicit BoxTree(std::span<const Bezier> rest);

  std::uint32_t tubeCount = 0;
  std::vector<std::uint32_t> tubes;       ///< slot -> tube, padded to whole groups by repeating the last
  std::vector<std::uint32_t> levelStart;  ///< first group of each level, and the end; at least level 0
  LargeVector<BoxGroup> boxes;            ///< all levels
  LargeVector<ChordCapsule> capsules;     ///< a slot each
  LargeVector<Bezier> shapes;  ///< the tubes' present shape, a slot each: neighbours in space are near in memory

  std::uint32_t levels() const { return std::uint32_t(levelStart.size()) - 1; }
  std::uint32_t groups(std::uint32_t level) const { return levelStart[level + 1] - levelStart[level]; }
  BoxTreeView view() {
    return {tubeCount,    levels(),        tubes.data(), levelStart.data(),
            boxes.data(), capsules.data(), shapes.data()};
  }
  std::size_t bytes() const {
    return tubes.size() * sizeof(std::uint32_t) + boxes.size() * sizeof(BoxGroup) +
           capsules.size() * sizeof(ChordCapsule) + shapes.size() * sizeof(Bezier);
  }
};

}  // namespace vasa
