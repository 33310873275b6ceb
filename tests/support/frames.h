#pragma once
#include "surface/sweep_table.h"

namespace vasa::test {

/// A network's knot frames in a pose with these points.
inline std::vector<quat> framesOf(const Network& network, std::span<const vec4> points) {
  std::vector<quat> frames(network.sectionCount());
  networkFrames(network, points, restReferences(network), frames);
  return frames;
}

/// The same at rest.
inline std::vector<quat> framesOf(const Network& network) { return framesOf(network, network.points()); }

}  // namespace vasa::test
