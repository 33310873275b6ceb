#pragma once
#include "curve/bezier.h"
#include "curve/frame.h"

namespace vasa {

/// Everything a ring of a sweep needs at one parameter.
struct Section {
  vec3 centre{0};
  float radius = 0;   ///< [m], not below 0
  Frame frame;        ///< u, v in the section's plane, tangent along the curve
  float slope = 0;    ///< dr/ds: r' / |C'|
  vec3 curvature{0};  ///< curvature vector [1/m], in the section's plane
};

/// A sweep's section at t. Where the curve stands still (C' = 0) the tangent is the chord's direction, then
/// the vessel's, then +z; slope and curvature are then zero.
/// @param vesselChord  last minus first de Boor point of the vessel
/// @param from, to     knot quaternions at t = 0 and 1 (curve/frame.h)
Section sectionAt(const Bezier& bezier, vec3 vesselChord, const quat& from, const quat& to, float t);

struct SurfacePoint {
  vec3 position;
  vec3 normal;  ///< unit, outward
};

/// The surface point in the direction (cos θ, sin θ) of the section's plane, with the surface's true normal:
///   S = C + r d,  d = cosθ u + sinθ v,  N ∥ d − r' / (|C'| (1 − r κ·d)) T.
/// Where the inside of a bend is about to fold (1 − r κ·d < 0.1) that factor is held at 0.1.
SurfacePoint surfacePoint(const Section& section, vec2 direction);

/// A point of the half sphere that closes an end.
/// @param polar    (cos φ, sin φ) of the angle from the rim, (1, 0), to the pole, (0, 1). The rim is the
/// tube's
///                 own ring, bit for bit.
/// @param outward  +1 at a vessel's last section, -1 at its first
SurfacePoint capPoint(const Section& section, vec2 direction, vec2 polar, float outward);

}  // namespace vasa
