#pragma once
#include "collide/contact.h"
#include "curve/bezier.h"

namespace vasa {

/// The place where two tubes come nearest: the least of the local minima of f that Newton steps in double
/// precision find from the nearest of 4x4 chords, and from all others that may come nearer and do not lie
/// beside it. A certain answer is closestOfTubes(). `i` and `j` of the result are 0 and 1. No allocation, a
/// microsecond or two.
Contact nearestPlace(const Bezier& a, const Bezier& b);

/// The same, from given parameters: follows a contact from one shape to the next.
Contact nearestPlaceFrom(const Bezier& a, const Bezier& b, float s, float t);

}  // namespace vasa
