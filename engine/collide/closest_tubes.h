#pragma once
#include "collide/contact.h"
#include "curve/bezier.h"

namespace vasa {

/// The truth about two tubes, in double precision: a branch and bound over both parameters whose lower bounds
/// are line-swept spheres around ever shorter pieces and whose upper bounds are values of f itself.
/// @param tolerance  [m] > 0, the width of the answer. The certain cost grows with -log2 of it.

/// Whether f(a, b) < margin. Certified both ways, except that within the tolerance it may be answered either
/// way.
bool tubesIntersect(const Bezier& a, const Bezier& b, double tolerance, double margin = 0);

/// The nearest place of a and b: a global minimum of f, no more than tolerance above the least value.
/// `i` and `j` of the result are 0 and 1.
Contact closestOfTubes(const Bezier& a, const Bezier& b, double tolerance);

}  // namespace vasa
