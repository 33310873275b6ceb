#pragma once
#include <span>

#include "math/types.h"

namespace vasa {

/// A section's orthonormal frame: u and v span the section's plane, tangent = u × v.
struct Frame {
  vec3 u, v, tangent;
};

/// Rotation-minimising frames along points with given unit tangents.
/// Method: double reflection (Wang, Jüttler, Zheng, Liu 2008).
/// @param points    [m] at least 1; equal neighbours are passed over
/// @param tangents  unit, one a point
/// @param start     direction whose part at right angles to tangents[0] becomes frames[0].u; if there is
///                  none, some perpendicular is taken
/// @param frames    caller-owned, one a point
/// O(n), no allocation.
void minimisingFrames(std::span<const vec3> points, std::span<const vec3> tangents, vec3 start,
                      std::span<Frame> frames);

/// Frames at the knots of a spline (spans + 1 of them) as unit quaternions that rotate x, y, z onto
/// u, v, tangent, carried by double reflection with kFrameSteps steps a span; neighbouring quaternions
/// lie in one hemisphere, so that a linear blend of them, normalised, is the frame between knots.
/// @param points  de Boor points of one vessel
/// @param start   reference direction, as in minimisingFrames: from the bone or the parent vessel, never
///                from a world axis
constexpr int kFrameSteps = 4;
void knotFrames(std::span<const vec4> points, vec3 start, std::span<quat> frames);

/// Unit tangent at u; where the derivative vanishes, the direction towards the next distinct point.
vec3 unitTangent(std::span<const vec4> points, float u);

/// The frame between two knot quaternions at t in [0, 1]: their normalised blend, its first axis then made
/// perpendicular to the exact `tangent`.
Frame interpolateFrame(const quat& from, const quat& to, float t, vec3 tangent);

}  // namespace vasa
