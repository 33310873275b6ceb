#pragma once
#include <span>
#include <vector>

#include "body/trunk.h"

namespace vasa {

/// A joint of a body's trunk that turns as none of the motion's does, but between two that follow one another
/// there.
struct TrunkShare {
  std::uint32_t joint;      ///< the body's
  std::uint32_t low, high;  ///< the motion's; the low one may be the hips
  float share;              ///< of the high one; 0 to 1
};

/// How a body's trunk bends as a motion's with more or fewer joints does.
struct TrunkSpread {
  std::vector<TrunkShare> shares;
  /// The body's trunk, at rest, cut where either has a joint, and which of the motion's joints turns each
  /// piece.
  struct Piece {
    std::uint32_t joint, source;
    vec3 way;
    bool takes;  ///< whether the joint is one that takes shares
  };
  std::vector<Piece> pieces;
};

/// Each bone takes the turn that the motion's trunk has at the bone's middle, by its share of the way from
/// hips to neck: the motion's bones are turned so at their own middles, and evenly from one to the next, so
/// that a bend is spread over joints that the motion lacks.
/// @param joints  of the body's trunk those that are to take shares
/// @param places  of the body's joints at rest
TrunkSpread spreadTrunk(const Trunk& motion, const Trunk& body, std::span<const std::uint32_t> joints,
                        std::span<const vec3> places);

/// Turns those joints; then all of them at once, by 0.6 at most, so that the way from hips to neck points
/// where it would if the body were bent in the very places where the motion is.
/// @param motion     turns of the motion's joints in space, from how they stand
/// @param alignment  of the body's joints (body/rest_alignment.h)
/// @param turns      of the body's joints in space, from rest
void turnTrunk(const TrunkSpread& spread, std::span<const quat> motion, std::span<const quat> alignment,
               std::span<quat> turns);

}  // namespace vasa
