#include "collide/box_tree.h"

#include <algorithm>

#include "collide/spatial_order.h"

namespace vasa {

BoxTree::BoxTree(std::span<const Bezier> rest) : tubeCount(std::uint32_t(rest.size())), levelStart{0} {
  std::vector<vec3> centres;
  centres.reserve(rest.size());
  for (const Bezier& tube : rest) centres.push_back(tube.bounds().centre());
  const std::vector<std::uint32_t> order = spatialOrder(centres);
  for (std::uint32_t groups = (tubeCount + kGroup - 1) / kGroup; groups > 0;
       groups = groups > 1 ? (groups + kGroup - 1) / kGroup : 0)
    levelStart.push_back(levelStart.back() + groups);
  boxes.resize(levelStart.back());
  moved.resize(boxes.size());
  for (std::uint32_t slot = 0; slot < slots(); ++slot)
    boxes[slot / kGroup].tubes[slot % kGroup] = order[std::min(slot, tubeCount - 1)];
}

void BoxTree::setShape(std::span<const Bezier> present, float wantedGrow) {
  constexpr std::uint32_t kSamples = 512;
  constexpr float kRoom = 1.25f, kLeastExtent = 1e-30f;
  tubes = present;
  grow = wantedGrow;
  Aabb starts;
  for (std::uint32_t slot = 0; slot < slots(); slot += std::max(1u, slots() / kSamples))
    starts.add(vec3(tubes[tubeAt(slot)].b[0]));
  const vec3 middle = starts.centre(), extent = starts.extent();
  for (int axis = 0; axis < 3; ++axis) {
    grid.middle[axis] = middle[axis];
    grid.stepsPerMetre[axis] = 2 * BoxGrid::kMost / std::max(kRoom * extent[axis], kLeastExtent);
  }
}

}  // namespace vasa
