#pragma once
#include <vector>

#include "network/network.h"

namespace vasa {

/// A network at rest whose vessels have been moved apart.
struct RestRepair {
  std::vector<vec4> points;  ///< as Network::points()
  std::size_t pairsBefore = 0, pairsAfter = 0;  ///< of tubes that overlap; neighbours along the network do not count
  float movedMax = 0;        ///< [m] the farthest that a de Boor point was moved
  float thinnedMax = 0;      ///< the largest share that a radius gave up
};

/// Moves vessels apart that overlap at rest, as sources draw them that were made one by one, and thins them where there is
/// no room: what the certificate of a frame would have to leave out (avoid/certificate.h). The same solver as in motion,
/// without a rest pose to keep to. What lies on or along another's centre line, as a vessel that is there twice, has no
/// side to go to and is left, as thin as it may become.
/// O(rounds · (pairs + tubes)), deterministic.
RestRepair separateAtRest(const Network& network);

}  // namespace vasa
