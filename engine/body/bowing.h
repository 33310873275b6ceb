#pragma once
#include <span>
#include <vector>

#include "body/binding.h"

namespace vasa {

/// How long a wave vessels bow out in [m]. A tube of 3 mm radius and 0.7 mm wall of 1 MPa in tissue of 5 to
/// 10 kPa buckles in waves of 2π (EI / k)^¼ = 31 mm; sweeps would have to be
/// half as long as the 15 mm that draw waves of 60 mm, which agree with the curvature and twist of bent legs'
/// arteries (`vasa realism`, P006 to P013).
constexpr float kBowWave = 0.06f;
/// Thinner vessels [m] are part of their bed; from half of this on they begin to bow.
constexpr float kBowRadius = 1.5e-3f;

/// Directions in which vessels stand off the axis of their limb, at rest: one a point, zero where there is
/// none. Vessels that run side by side have nearly the same.
std::vector<vec3> outwardsOf(const Binding& binding, std::span<const vec4> rest);

/// A course of vessels whose points are `rest`, squeezed between them.
struct BowCourse {
  std::span<const float> along;  ///< [m] at rest, of each point
  std::span<const float>
      stretch;  ///< before each point: length in the pose by that at rest; the first counts not
  std::span<const vec4> rest;      ///< (x, y, z, r)
  std::span<const vec3> outwards;  ///< outwardsOf()
  std::span<const quat> turned;    ///< how the bed of each has turned
  std::span<const float> holds;    ///< [m] along it where it stays in its bed: forks at its ends, tunnels
};

/// How far each control point [m] moves when a course that is squeezed bows out of its bed.
///
/// Of what a pose takes from a vessel's length a quarter goes into a helix about its course: it shortens by
/// less, bends and twists more, as living arteries do. The helix turns with the height (or whatever axis of
/// rest the course mainly follows), right-handed on one side of the body and left-handed on the other, so
/// that vessels that run side by side bow together. Nothing bows at rest, where it is stretched, or where it
/// is held. Continuous in the pose. O(points)
/// @param lost   room for one a point
/// @param aside  one a point on return
void bow(const BowCourse& course, std::span<float> lost, std::span<vec3> aside);

}  // namespace vasa
