#pragma once
#include "network/network.h"

namespace vasa {

/// A vessel that two networks both have, each with all the pieces that bear its name: how long it is in
/// either, and how far apart the two run.
struct VesselComparison {
  std::string name;  ///< in the first network
  VesselKind kind = VesselKind::other;
  double length = 0, otherLength = 0;  ///< [m]
  /// [m] mean over the first's centre line to the nearest place of the other's
  double distance = 0;
  double otherDistance = 0;  ///< [m] mean over the other's

  double lengthRatio() const { return length / otherLength; }
  /// [m] of the two means the smaller: where one of the two is told farther than the other, only what both
  /// tell counts.
  double apart() const { return distance < otherDistance ? distance : otherDistance; }
};

/// Compares what two networks in the same body tell of each vessel that both have, in the order of the first.
/// Two vessels are the same if they have one name (the ` (2)` of further pieces aside) or else one ontology
/// id. Distances are taken every 2 mm. O(the two lengths of each vessel, multiplied), in parallel over
/// vessels.
std::vector<VesselComparison> compareVessels(const Network& network, const Network& other);

}  // namespace vasa
