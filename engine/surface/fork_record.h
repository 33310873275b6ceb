#pragma once
#include <vector>

#include "shared/fork.h"
#include "surface/vessel_line.h"

namespace vasa {

/// The course of one fork at rest.
struct ForkCourse {
  LinePlace low, high;  ///< the trunk's two rings
  float length = 0;     ///< [m] from low to high
  struct Branch {
    LinePlace ring, cross;  ///< where its tube begins, where its axis pierces the wall
    bool last = false;      ///< it runs towards its line's first end
    vec3 centre{0};         ///< on the trunk's axis, below the hole's middle
    float hole = 0;         ///< [m] half length of the hole along the trunk
    float around = 0;       ///< sine of the hole's half angle
    /// Where wall and branch would meet without a fillet: shares of the hole.
    float cornerAround = 0, cornerAlong = 0;
  };
  std::vector<Branch> branches;  ///< at most kMostBranches
};

/// What the fork's evaluation reads in every pose (surface/fork.h); its branches are added to `branches`.
shared::ForkRecord makeForkRecord(const Network& network, const ForkCourse& course,
                                  std::vector<shared::ForkBranch>& branches);

/// A ring at a place. Its turn is +1 where the place is not reversed.
shared::ForkRing forkRingAt(const Network& network, const LinePlace& place);

/// Class of a span among `spans` (spanClassMatrices of surface/sweep_table.h).
std::uint32_t spanClassOf(std::uint32_t span, std::uint32_t spans);

}  // namespace vasa
