#pragma once
#include "network/network.h"

namespace vasa {

/// A vessel that two networks both have, each with all the pieces that bear its name: how long it is in
/// either, and how far apart the two run.
///
/// Of a vessel that is told as a tree (all branches under one name) the course is compared: the longest way
/// along pieces that are joined. Twigs that one of the two tells and the other does not make it no longer.
struct VesselComparison {
  std::string name;  ///< in the first network
  std::string otherName;
  VesselKind kind = VesselKind::other;
  double length = 0, otherLength = 0;  ///< [m] of the courses
  double whole = 0, otherWhole = 0;    ///< [m] of all pieces
  /// [m] of the stretch that both courses tell: between the places nearest to the other's ends, however far
  /// off these are. Zero where they run across one another.
  double shared = 0, otherShared = 0;
  /// [m] mean over the first's course to the nearest place of any of the other's pieces
  double distance = 0;
  double otherDistance = 0;  ///< [m] mean over the other's

  double lengthRatio() const { return length / otherLength; }
  /// Of the shared stretches; 0 where there is none.
  double sharedRatio() const { return shared > 0 && otherShared > 0 ? shared / otherShared : 0; }
  /// [m] of the two means the smaller: where one of the two is told farther than the other, only what both
  /// tell counts.
  double apart() const { return distance < otherDistance ? distance : otherDistance; }
};

/// Compares what two networks in the same body tell of each vessel that both have, in the order of the first.
/// Two vessels are the same if they have one name (the ` (2)` of further pieces aside) or else one ontology
/// id. Where several on one side have the id of something on the other (a class: "lumbar vein"), all that
/// have it are compared at once, under the first one's name. Distances are taken every 2 mm. O(the two
/// lengths of each vessel, multiplied), in parallel over vessels.
std::vector<VesselComparison> compareVessels(const Network& network, const Network& other);

}  // namespace vasa
