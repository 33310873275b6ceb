#pragma once
#include <span>
#include <vector>

#include "collide/closest_tubes.h"
#include "collide/exclusions.h"

namespace vasa::test {

/// Every intersecting pair by comparing all with all: the specification of the detectors, O(n²).
inline std::vector<TubePair> intersectingPairsByBruteForce(std::span<const Bezier> tubes,
                                                           const Exclusions& exclusions, double tolerance) {
  std::vector<Aabb> boxes;
  for (const Bezier& tube : tubes) boxes.push_back(tube.bounds());
  std::vector<TubePair> pairs;
  for (std::uint32_t i = 0; i < tubes.size(); ++i)
    for (std::uint32_t j = i + 1; j < tubes.size(); ++j)
      if (boxes[i].overlaps(boxes[j]) && !exclusions.contains(i, j) &&
          tubesIntersect(tubes[i], tubes[j], tolerance))
        pairs.push_back({i, j});
  return pairs;
}

}  // namespace vasa::test
