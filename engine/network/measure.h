#pragma once
#include "network/network.h"

namespace vasa {

struct NetworkMeasures {
  std::uint32_t arteries = 0;  ///< vessels of kind artery
  std::uint32_t veins = 0;     ///< vessels of kind vein or portal vein
  double length = 0;           ///< [m] of all centre lines
  double volume = 0;           ///< [m³] sum over vessels
  Aabb bounds;                 ///< of all tubes
};

/// Counts, lengths and volumes of a network in the given shape (rest or posed). O(spans).
NetworkMeasures measure(const Network& network, std::span<const vec4> points);

}  // namespace vasa
