#pragma once
#include <span>
#include <vector>

#include "body/bone_field.h"
#include "body/skin_field.h"

namespace vasa {

/// Two points that are next to each other along a vessel or where vessels meet.
struct Tie {
  std::uint32_t a, b;
};

/// In what shares each joint has set in at each point, all from 0 to 1. Tables are joint after joint.
struct Phases {
  std::size_t pointCount = 0;
  std::vector<float> bend;      ///< 0 with the bones before the joint, 1 with those behind it
  std::vector<float> twist;     ///< of the joint's twist, where it is spread along the link; 1 elsewhere
  std::vector<float> nearness;  ///< 1: the nearest of the limbs that start at one joint; 0: no part of it

  std::size_t at(std::size_t joint, std::size_t point) const { return joint * pointCount + point; }
};

/// Measures the phases from the bones and the skin.
///
/// How far a point is beyond a joint's plane follows from its distances to the bones before and behind the
/// joint; bend is a smoothstep of that over the joint's arc. Where those bones come close again away from the
/// joint (an arm beside the chest) the arc narrows, so that each bone keeps what is on it, and what lies
/// close to the limb goes with it. Around a joint, where the bones before and behind are about equally near
/// (the hip bone reaches far beside the thigh's), the skin that is near decides with them: vessels must move
/// as the flesh does, also where another bone is nearer. Flesh around the link after the joint is
/// at least as far on as on a straight limb (the seat bone reaches far down beside the thigh). Where the skin
/// around a point belongs to limbs, it also tells which of them take part, so that one leg has no share in
/// the other. Twist grows along the link, sooner near the joint's own bone and later near the one that runs
/// beside it. O(points · joints), in parallel.
/// @param skin  of the same body; without one, bones alone decide
Phases measurePhases(const SpineSet& spines, const BoneField& bones, const SkinField& skin,
                     std::span<const vec4> points);

/// Makes no phase change faster along a tie than the joint's arc does along a straight limb: a vessel that
/// passes from one bone's neighbourhood to another's is not torn, however close the bones are. Method: mean
/// of the smallest majorant and the largest minorant of the wanted slope, which leaves alone what is flat
/// enough.
void limitSlopes(Phases& phases, const SpineSet& spines, std::span<const vec4> points,
                 std::span<const Tie> ties);

}  // namespace vasa
