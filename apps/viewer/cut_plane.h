#pragma once
#include <array>

#include "math/aabb.h"

namespace vasa::viewer {

/// A plane that cuts the body open, in any direction, fixed to the body and not to the eye.
struct CutPlane {
  bool on = false;
  float turn = 0;     ///< [degrees] of the side that is cut off, from the front towards the body's left
  float tilt = 0;     ///< [degrees] and upwards
  float place = 0.5;  ///< 0: nothing is cut off, 1: all
  bool operator==(const CutPlane&) const = default;
};

/// Unit, towards what is cut off.
vec3 cutDirection(const CutPlane& cut);
/// For Camera::cut. @param box  of the body, where it is now
vec4 cutThrough(const CutPlane& cut, const Aabb& box);
/// Corners of the plane's piece that holds the box's outline, one after the other.
std::array<vec3, 4> cutOutline(const CutPlane& cut, const Aabb& box);
/// The plane that faces a viewer who looks along `forward`.
void faceViewer(CutPlane& cut, vec3 forward);

}  // namespace vasa::viewer
