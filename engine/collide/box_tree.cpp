#include "collide/box_tree.h"

#include "collide/spatial_order.h"

namespace vasa {

BoxTree::BoxTree(std::span<const Bezier> rest) : tubeCount(std::uint32_t(rest.size())), levelStart{0} {
  std::vector<vec3> centres;
  centres.reserve(rest.size());
  for (const Bezier& tube : rest) centres.push_back(tube.bounds().centre());
  tubes = spatialOrder(centres);
  while (tubes.size() % kGroup) tubes.push_back(tubes.back());
  for (std::uint32_t groups = std::uint32_t(tubes.size()) / kGroup; groups > 0;
       groups = groups > 1 ? (groups + kGroup - 1) / kGroup : 0)
    levelStart.push_back(levelStart.back() + groups);
  boxes.resize(levelStart.back());
  capsules.resize(tubes.size());
  shapes.resize(tubes.size());
}

}  // namespace vasa
