// Read by C++ and GLSL (std430): how a template is filled. A frame's tubes and forks take several rounds, one
// a template:
//   tubes   a workgroup a group of sweeps, from the first that no earlier round had room for
//   forks   likewise, once all tubes have been there
//   plan    one workgroup: draws only those groups before the first that found no room, so that everything is
//   drawn once and in
//           its order, and says what the next round's dispatches begin with
// Groups take room as they need it, by what can be seen. Which memory they get, and where a round ends, may
// change from frame to frame; what is drawn and in which order may not.
#ifndef VASA_SHARED_FILLING_H
#define VASA_SHARED_FILLING_H
#include "shared/detail.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

/// Most groups of tubes and of forks in a round, each a draw.
VASA_CONSTANT uint kWindow = 64;
VASA_CONSTANT uint kPlanThreads = 64;

/// Room of a template, in blocks: kBlockVertices vertices, or as many indices as take that memory.
struct FillRoom {
  uint blocks;
  uint reserve;  // that the round's first group may take whatever the others did: the most any group needs
  uint tubeWindow, forkWindow;  // groups in a round at most
};

struct Filling {
  uint undoneTube, undoneFork;    // the first sweep and fork that this round has no room for
  uint taken;                     // blocks of the template
  int spare;                      // blocks that any but the first group may take
  uint firstTube, firstFork;      // where this round begins
  uint tubeEnd, forkEnd;          // of the frame
  uint indices, blocks, rounds;   // of the frame so far
  uint tubeGroups, tubeY, tubeZ;  // VkDispatchIndirectCommand
  uint forkGroups, forkY, forkZ;
};

#ifndef __cplusplus
VASA_MEMORY(4) coherent buffer Fill { Filling state; };
#else
static_assert(sizeof(Filling) == 68 && offsetof(Filling, tubeGroups) == 44 && sizeof(FillRoom) == 16);
}  // namespace vasa::shared
#endif
#endif
