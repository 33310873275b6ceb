// Room in a template for what a group of tubes or forks writes: vertices in whole blocks, its indices behind them.
#ifndef VASA_TEMPLATE_ROOM
#define VASA_TEMPLATE_ROOM
#include "shared/tubes.h"

const uint kNoRoom = 0xffffffffu, kBlockWords = 4 * kBlockVertices;

uint blocksOf(uint vertexBlocks, uint triangles) { return vertexBlocks + (3 * triangles + kBlockWords - 1) / kBlockWords; }

// @return the first of the blocks. The round's first group always finds room; what others find depends on who asks first.
uint takeBlocks(Fill filling, uint blocks, bool first, uint reserve) {
  if (first) atomicAdd(filling.state.spare, int(reserve) - int(blocks));
  if (blocks == 0) return 0;
  if (!first && atomicAdd(filling.state.spare, -int(blocks)) < int(blocks)) {
    atomicAdd(filling.state.spare, int(blocks));
    return kNoRoom;
  }
  return atomicAdd(filling.state.taken, blocks);
}

#endif
