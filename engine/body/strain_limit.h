#pragma once
#include <span>

#include "network/network.h"

namespace vasa {

/// What was done to vessels that changed their length otherwise than what lies around them.
struct StrainLimitReport {
  std::uint32_t held = 0;    ///< pieces that were beyond the limit and are no more
  std::uint32_t beyond = 0;  ///< pieces that are still
  float worst = 1;           ///< times longer, or shorter, than around them, of what is beyond
};

/// Longer or shorter than around it by this at the most: between people an artery's length beside that of its
/// region varies by some 13 % (standard deviation), so this is three of them.
constexpr float kMostUnevenStrain = 1.5f;

/// Holds the strain of a network that was carried to another body.
///
/// A piece of a vessel (some 2 cm, shorter vessels as a whole) is compared with the pieces around it (within
/// 3 % of the body's height, before): the median of their changes of length is what the place asks for, as
/// where a head is larger. Steps between de Boor points of pieces beyond the limit are shortened or
/// lengthened to it by moving both their points, ends with what they meet (an end on a host's side moves the
/// host a little); this is done in turn, until none is beyond or for a number of rounds (position based
/// dynamics, Müller et al. 2007). What can not be held so, as between two hosts that lie elsewhere, is told.
/// @param before  as Network::points() [m]
/// @param points  the same after, moved; ends lie on their nodes, before and after
/// O(points · rounds); a pure function of its input
StrainLimitReport limitStrain(const Network& network, std::span<const vec4> before, std::span<vec4> points);

}  // namespace vasa
