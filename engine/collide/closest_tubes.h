#pragma once
#include <span>
#include <vector>

#include "collide/contact.h"
#include "collide/neighbours.h"
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

/// The same for two neighbours of a network: only pairs of points count whose arc length through the network,
/// over every link, is at least neighbours.reach() times the sum of their radii. Where none counts, the tubes
/// are apart (f = +inf). `pair` is an entry of neighbours.pairs(), a and b its tubes.
bool neighboursIntersect(const Bezier& a, const Bezier& b, const Neighbours& neighbours,
                         const NeighbourPair& pair, double tolerance, double margin = 0);
Contact closestOfNeighbours(const Bezier& a, const Bezier& b, const Neighbours& neighbours,
                            const NeighbourPair& pair, double tolerance);

/// Whether every pair of points that counts is certainly further apart than the margin, by the directions of
/// the two control polygons alone: tubes joined by one link that run on within 60° of a common axis. Cheap;
/// false says nothing.
bool neighboursRunOn(const Bezier& a, const Bezier& b, const Neighbours& neighbours,
                     const NeighbourPair& pair, float margin);

/// The neighbours that intersect where points count, sorted. Parallel over pairs.
std::vector<TubePair> intersectingNeighbours(std::span<const Bezier> tubes, const Neighbours& neighbours,
                                             double tolerance, double margin = 0);

/// Every intersecting pair by comparing all with all: the specification, O(n²), for tests and tiny inputs.
std::vector<TubePair> intersectingPairsByBruteForce(std::span<const Bezier> tubes,
                                                    const Exclusions& exclusions, double tolerance);

}  // namespace vasa
