#pragma once
#include "surface/vessel_line.h"

namespace vasa {

/// Where a branch's tube leaves its host's, found at rest.
struct ForkExit {
  bool found = false;
  bool clear = false;  ///< the whole ring at `ring` stands off the host; else the best there is
  float cross = 0;  ///< way along the branch from its end: its axis pierces the host's wall, or a few radii
                    ///< before `ring` where that is later
  float ring = 0;   ///< way along the branch: its tube begins here
  float foot = 0;   ///< way along the host beside `cross`
  float ringFoot = 0;  ///< way along the host beside `ring`
  float radius = 0;    ///< of the branch at `ring`
  float lean = 0;      ///< cosine between branch and host there
  bool operator==(const ForkExit&) const = default;
};

/// @param last     the branch is the line's last end, so that ways count from there
/// @param hostWay  where the branch's end lies on the host
/// The branch is followed until its ring is out of the host; not found where it never comes out.
/// @param clearance  between ring and host, in radii of the branch
/// @param longest    of the way from `cross` to `ring`, in radii of the branch
ForkExit findForkExit(const VesselLine& branch, bool last, const VesselLine& host, float hostWay,
                      float clearance, float longest);

}  // namespace vasa
