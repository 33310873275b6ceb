#pragma once
#include <vector>

#include "body/body.h"
#include "make_human/rig.h"

namespace vasa::human {

using Weights = std::vector<float>;  ///< one a joint

/// Adds a share to the weights of the joints along a path that move what lies at p: each passes to the next
/// over that one's blend length.
void addPathWeights(const std::vector<int>& path, const Rig& rig, vec3 p, float share, Weights& weights);

/// The four largest, those that hardly count left out; they sum to one.
SkinInfluence strongest(const Weights& weights);

}  // namespace vasa::human
