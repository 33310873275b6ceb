#pragma once
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace vasa {

/// A rough axis between two nodes: centres with radius estimates, from the start node's side to the end
/// node's, without the nodes themselves.
struct AxisChain {
  std::uint32_t start = 0, end = 0;
  std::vector<vec4> points;
  float length = 0;  ///< [m] along the surface, from where the chain leaves its start to its end
};

/// What level sets or rings give of one connected piece: chains that meet at nodes.
struct AxisGraph {
  std::vector<vec3> nodes;
  std::vector<AxisChain> chains;

  std::vector<std::uint32_t> valences() const;
};

/// One end of a chain at a node.
struct ChainEnd {
  std::uint32_t chain;
  bool last;
};
/// The chain ends at each node, in the order of the chains; a chain that returns to its node appears twice.
std::vector<std::vector<ChainEnd>> chainEnds(const AxisGraph& graph);

/// Removes nodes that no chain names, and makes one chain of two wherever only two ends meet.
void compact(AxisGraph& graph);

/// Length of a polyline, and the smoothed, evenly spaced version of it.
float polylineLength(const std::vector<vec4>& points);

}  // namespace vasa
