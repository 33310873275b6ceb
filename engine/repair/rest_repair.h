#pragma once
#include <string_view>
#include <vector>

#include "network/network.h"

namespace vasa {

/// Why two vessels still overlap: there is no room; the thinner lies wholly in the other; both tell the same
/// course; or nothing was done about it.
enum class OverlapReason : std::uint8_t { noRoom, inside, twice, asTold };
std::string_view reasonName(OverlapReason reason);  ///< "no room", "inside", "twice", "as told"

/// Two vessels, or one and itself, that overlap at rest in spite of all.
struct RestOverlap {
  VesselId first, second;
  std::uint32_t pairs = 0;  ///< of their tubes
  float depth = 0;          ///< [m] the deepest
  OverlapReason reason = OverlapReason::noRoom;
};

/// A network at rest whose vessels have been moved apart.
struct RestRepair {
  Network network;
  /// Of tubes that overlap; neighbours along the network do not count.
  std::size_t pairsBefore = 0, pairsAfter = 0;
  float movedMax = 0;             ///< [m] the farthest that a de Boor point was moved
  float thinnedMax = 0;           ///< the largest share that a radius gave up
  std::vector<RestOverlap> left;  ///< deepest first, then by vessel
};

/// Parts vessels that overlap at rest, as sources draw them that were made one by one: what the certificate
/// of a frame would have to leave out (avoid/certificate.h). They are moved aside, the thin more than the
/// wide, and where there is no room for that, thinned (repair/rest_parting.h). Between them stays what
/// rounding them in a file may take away (network/file.h). Two vessels that run along the same course are one
/// told twice: there is no side to go to, and both are left as they are. So is a tangle, which has several
/// times as many pairs as sweeps. Thinner vessels have fewer neighbours along the network
/// (collide/neighbours.h), so these are looked up anew between passes. O(steps · (tubes + overlaps · points
/// that one moves)), deterministic. Can be cancelled (core/cancellation.h).
RestRepair separateAtRest(const Network& network);
/// Nothing done: only what overlaps is told.
RestRepair overlapsAtRest(const Network& network);

}  // namespace vasa
