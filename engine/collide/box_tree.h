#pragma once
#include <span>
#include <vector>

#include "core/large_pages.h"
#include "curve/bezier.h"

namespace vasa {

constexpr std::uint32_t kGroup = 8;  ///< children of a node, and lanes that are tested together

/// Where boxes are measured: coordinate v lies at step (v - middle) stepsPerMetre of an axis, held to kMost
/// either way and cut to a whole number. All of that never falls where v grows, so that boxes that meet still
/// do in steps, whatever the grid and the rounding; a grid that is too coarse or lies elsewhere only costs
/// time.
struct BoxGrid {
  static constexpr std::int16_t kMost = 32766;
  float middle[3] = {};
  float stepsPerMetre[3] = {};
};

/// Eight boxes, one a lane, in steps: from low to before high. A lane without a box is empty: low = 32767,
/// high = -32768. Two lines of the cache hold all that a traversal reads of them.
struct alignas(128) BoxGroup {
  std::int16_t low[3][kGroup];
  std::int16_t high[3][kGroup];
  std::uint32_t tubes[kGroup];  ///< level 0: the tubes in the boxes, the last one again where there are fewer
};

/// What the kernels see of a BoxTree: raw arrays, because code compiled for one instruction set must not
/// instantiate inline library functions that the linker could then hand to all.
struct BoxTreeView {
  std::uint32_t tubeCount, levels;
  const std::uint32_t* levelStart;
  BoxGroup* boxes;
  const std::uint8_t* moved;  ///< a group each: bit k where lane k holds something that moved since it was
                              ///< tested last
  const Bezier* tubes;        ///< the caller's
  float grow;                 ///< [m] what their radii are to be larger by
  BoxGrid grid;
};

/// The fast detector's tree: topology fixed at rest and implicit (group g of a level holds the boxes of
/// groups 8g .. 8g+7 of the level below; groups of level 0 hold tubes), structure of arrays, no pointers, 18
/// bytes a tube. Tubes are read where the caller has them. Filled by the kernels (collide/kernels.h).
struct BoxTree {
  /// Order and topology from the tubes at rest; boxes are not filled yet.
  explicit BoxTree(std::span<const Bezier> rest);

  /// The tubes' present shape, which must stay in place while the tree is used, and a grid around it: around
  /// the starts of some 500 tubes and an eighth of their extent more on either side.
  void setShape(std::span<const Bezier> present, float grow);

  std::uint32_t tubeCount = 0;
  std::vector<std::uint32_t> levelStart;  ///< first group of each level, and the end; at least level 0
  LargeVector<BoxGroup> boxes;            ///< all levels
  std::vector<std::uint8_t> moved;        ///< BoxTreeView::moved
  std::span<const Bezier> tubes;
  float grow = 0;
  BoxGrid grid;

  std::uint32_t levels() const { return std::uint32_t(levelStart.size()) - 1; }
  std::uint32_t groups(std::uint32_t level) const { return levelStart[level + 1] - levelStart[level]; }
  std::uint32_t slots() const { return tubeCount > 0 ? groups(0) * kGroup : 0; }
  std::uint32_t tubeAt(std::uint32_t slot) const { return boxes[slot / kGroup].tubes[slot % kGroup]; }
  BoxTreeView view() {
    return {tubeCount, levels(), levelStart.data(), boxes.data(), moved.data(), tubes.data(), grow, grid};
  }
  std::size_t bytes() const { return boxes.size() * (sizeof(BoxGroup) + sizeof(moved[0])); }
};

}  // namespace vasa
