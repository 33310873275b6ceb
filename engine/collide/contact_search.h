#pragma once
#include "collide/contact.h"
#include "curve/bezier.h"

namespace vasa {

/// A place where two tubes come nearest: a local minimum of f, found by Newton steps in double precision from
/// the nearest of 4x4 chords. For tubes that bend less than half a turn that is the global one; a certain
/// answer is closestOfTubes(). `i` and `j` of the result are 0 and 1. No allocation, under a microsecond.
Contact nearestPlace(const Bezier& a, const Bezier& b);

/// The same, from given parameters: follows a contact from one shape to the next.
Contact nearestPlaceFrom(const Bezier& a, const Bezier& b, float s, float t);

}  // namespace vasa
