#pragma once
#include <span>
#include <vector>

#include "avoid/room.h"

namespace vasa {

/// Part of a vessel, between two places along it, in spans.
struct Stretch {
  VesselId vessel;
  float from = 0, to = 0;
};

/// How some points of a vessel are to move.
struct Detour {
  VesselId vessel;
  std::uint32_t firstPoint = 0;  ///< of the vessel's
  std::vector<vec3> motions;     ///< [m] one a point, from the first on
};

/// A way around bones and other vessels for a stretch that no pushing frees, as where two bones push against one
/// another: found by search (avoid/way.h), then the vessel's points move until its spline runs along it (progressive
/// iterative approximation, Lin, Wang, Dong 2004) and are pushed off what is still too near. The vessel moves some spans
/// before and behind the stretch, nothing else does; ends on nodes stay. Deterministic.
/// @param stretch       in the way
/// @param points        the network as it is now, the shape of interference.tubes()
/// @param bones         posed
/// @param factor        how wide it needs to be, by its radii at rest
/// @return no motions where there is no way. Some milliseconds
Detour findDetour(const Network& network, const Interference& interference, const Bones& bones, const Stretch& stretch,
                  std::span<const vec4> points, float factor);

}  // namespace vasa
