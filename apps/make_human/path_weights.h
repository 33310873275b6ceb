#pragma once
#include <vector>

#include "body/body.h"
#include "make_human/rig.h"

namespace vasa::human {

using Weights = std::vector<float>;  ///< one a joint

/// How far along a path of joints a place lies [m], and how far along each joint is.
struct PathPosition {
  float along = 0;
  std::vector<float> joints;
};
/// Along the links themselves, from the nearest of them: for what lies around a limb.
PathPosition alongPath(const std::vector<int>& path, const Rig& rig, vec3 p);
/// Along the straight way from the first joint to the last link's end: smooth also far from the links, for
/// what the trunk encloses.
PathPosition upPath(const std::vector<int>& path, const Rig& rig, vec3 p);

/// Adds a share to the weights of the joints along a path that move what lies there: each passes to the next
/// over that one's blend length.
void addPathWeights(const std::vector<int>& path, const Rig& rig, const PathPosition& position, float share,
                    Weights& weights);

/// The four largest, those that hardly count left out; they sum to one.
SkinInfluence strongest(const Weights& weights);

}  // namespace vasa::human
