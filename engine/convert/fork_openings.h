#pragma once
#include <vector>

#include "convert/joined_wall.h"
#include "convert/wall_cut.h"
#include "math/capsule.h"
#include "surface/fork_rings.h"

namespace vasa {

/// A fork's ring, and beside it, nearer to the fork, where its wall is cut.
struct ForkOpening {
  VesselId vessel;
  float parameter = 0;  ///< of the ring on its vessel
  float outward = 1;    ///< 1 or -1, times the parameter: away from the fork
  float farthest = 0;   ///< the ring may move out to this parameter
  vec4 section{0};      ///< of the ring
  vec3 direction{0};    ///< unit, outwards
  WallOpening cut;
};

/// A fork's openings where it was planned, the trunk's two first. The tube behind a ring may be used up by
/// half, and almost all of it where no other fork follows.
std::vector<ForkOpening> forkOpenings(const Network& network, const ForkPlan& plan,
                                      const shared::ForkRecord& fork);

/// The opening so much further out [m], or as far as it may go.
ForkOpening movedOut(const Network& network, ForkOpening opening, float distance);

/// Moves openings out until what the walls enclose in the plane of the cut is one vessel's section about its
/// axis: real walls of two vessels part later than their round tubes. One that finds no such place stays.
void moveBeyondUnion(const Network& network, std::span<const LooseWall* const> walls,
                     std::span<ForkOpening> openings);

/// Thin tubes around the axes of a fork's vessels, between its openings: what joins its walls where the
/// source has gaps.
std::vector<Capsule> forkCores(const Network& network, std::span<const ForkOpening> openings);

}  // namespace vasa
