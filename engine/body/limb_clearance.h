#pragma once
#include <span>
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa {

/// What was done so that an arm does not pass through the rest of the body, or legs through one another.
struct ClearedLimb {
  std::string clip = {}, joint;  ///< the upper arm's; the left thigh's, of both legs
  std::string other = {};        ///< of legs, the right thigh's
  std::uint32_t frames = 0;      ///< in which its skin lay deeper in the other's than at rest, by kFleshGives
  std::uint32_t left = 0;        ///< in which it still does
  float before = 0, after = 0;   ///< [m] depth, at most
  float turn = 0;                ///< [rad] at most; of legs, the sum of both
};

/// Flesh that is pressed on gives way by as much [m]. Vessels lie deeper, but for the smallest.
constexpr float kFleshGives = 0.002f;

constexpr std::uint32_t kMostClearedFrames = 36'000;  ///< twenty minutes of 30 a second

/// Recorded motions come from other people: carried to a body with wider hips or longer arms, hands and lower
/// arms pass through thighs and trunk, calves and knees through one another. No vessels can follow there
/// without passing through one another. So the upper arm is turned, by as little as takes the skin of lower
/// arm and hand out of the rest of the skin, sooner and later by less, over a fifth of a second to both
/// sides: in a motion that goes round, across its seam. Of legs both thighs are, by half each.
///
/// Method: the skin without the limb at rest is the boundary of the body; a place on the limb is looked up
/// there from the space of each joint that the body's skin follows, where that joint moved it most. Newton's
/// steps out of the deepest place, frame by frame; then the greatest turn of all frames near by, averaged.
/// Clips that keep clear are left as they are, to the bit, as are bodies without a skin or without limbs
/// known by name or shape. A turn of more than half a radian (of legs, a quarter) is not made: an arm that
/// goes right through a trunk is no motion of this body. Clips of more than kMostClearedFrames are not looked
/// at.
///
///   for (const ClearedLimb& limb : keepLimbsClear(body, {&clip, 1})) ...
///
/// O(frames · places on the limb · log triangles), in parallel: some 0.1 ms a frame that keeps clear, 2 ms
/// others; 3 kB.
std::vector<ClearedLimb> keepLimbsClear(const Body& body, std::span<Clip> clips);

}  // namespace vasa
