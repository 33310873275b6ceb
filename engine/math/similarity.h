#pragma once
#include <span>
#include <utility>

#include "math/types.h"

namespace vasa {

/// x -> scale · turn · x + move
struct Similarity {
  float scale = 1;
  quat turn{1, 0, 0, 0};
  vec3 move{0};
  vec3 operator()(vec3 x) const { return scale * (turn * x) + move; }
};

/// The similarity that takes the first place of each pair nearest to its second one, in the least squares
/// (Horn 1987): of one pair a move, of two (or of pairs in a line) the shortest turn too.
/// @param rigid  keep the size. Empty pairs give the identity. O(pairs)
Similarity fitSimilarity(std::span<const std::pair<vec3, vec3>> pairs, bool rigid);

}  // namespace vasa
