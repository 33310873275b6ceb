#pragma once
#include <vector>

#include "math/types.h"

namespace vasa {

/// Polylines that share samples, cut up as other programs write graphs (two points each, as a rule), put
/// together again: where two of them meet, they go on in one; where more meet, the two that go on straightest
/// (then: whose radii are most alike) do, and the others end there, at a sample of theirs. What is told twice
/// is told once. Samples are shared that are at the same place, an end also with another line's sample within
/// 5 % of its radius.
/// @param lines  (x, y, z, r), neighbours distinct
/// O(n log n) in samples
std::vector<std::vector<vec4>> chainLines(const std::vector<std::vector<vec4>>& lines);

}  // namespace vasa
