#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "surface/fork_exit.h"
#include "surface/fork_room.h"

namespace vasa {

constexpr float kBesideJoin = 0.15f;  ///< of the radius: the least a join takes

/// A branch that leaves a line.
struct ForkLeaving {
  std::uint32_t child = 0;  ///< 2 * line + end
  ForkExit exit;
  float centre = 0;   ///< way along the host
  vec3 direction{0};  ///< unit, from the host's axis
  float hole = 0, around = 0, radius = 0, cornerAround = 0, cornerAlong = 0;
  bool operator==(const ForkLeaving&) const = default;
};

/// One or two branches, or a join, or both, on a line: what becomes one fork.
struct ForkItem {
  ForkRoom room;
  std::vector<ForkLeaving> branches;
  float radius = 0, shiftLimit = 0;
  float mustLow = 1e30f, mustHigh = -1e30f;  ///< a join within

  bool operator==(const ForkItem&) const = default;
  bool branch() const { return !branches.empty(); }
  const ForkLeaving& thinnest() const {
    return *std::min_element(branches.begin(), branches.end(),
                             [](const ForkLeaving& a, const ForkLeaving& b) { return a.radius < b.radius; });
  }
};

/// @param end     of `branch`: 2 * line, and one more for its last end
/// @param fillet  in radii of the branch
ForkItem branchItem(const VesselLine& host, const VesselLine& branch, std::uint32_t end, const ForkExit& exit,
                    float fillet);

/// What is on a line, in order: branches that need the same room on different sides of it as one, and its
/// joins between these ways, each with the branch beside it or alone.
std::vector<ForkItem> arrangedItems(const VesselLine& line, std::vector<ForkItem> branches, float low,
                                    float high);

/// Gives what is on a line room between two ways along it.
/// @param rooms   empty; one an item on return  @param sliver  [m] shorter tubes go to the forks beside them
/// @return the one with a branch that is in the way most; null if there is room for all
const ForkItem* withoutRoom(std::span<const ForkItem> items, std::vector<ForkRoom>& rooms, float low,
                            float high, float sliver);

}  // namespace vasa
