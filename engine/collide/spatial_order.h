#pragma once
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa {

/// An order in which points that lie near one another get near numbers, made for an implicit 8-ary tree:
/// every run of 8, 64, 512 ... starting at a multiple of its length is compact. Method: halving along the
/// longest side of the points' box, at the multiple of the tree's arity nearest to the middle. Deterministic.
/// O(n log² n).
std::vector<std::uint32_t> spatialOrder(std::span<const vec3> points);

}  // namespace vasa
