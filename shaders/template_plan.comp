#version 460
// One workgroup: what of a round is drawn, and where the next one begins (shared/filling.h).
#extension GL_GOOGLE_include_directive : require
#include "shared/tubes.h"

layout(local_size_x = kPlanThreads) in;
layout(push_constant, std430) uniform Push { PlanPush push; };
shared uint indices;

void keep(uint draw, bool kept) {
  if (kept) atomicAdd(indices, push.draws.draw[draw].indexCount);
  else push.draws.draw[draw] = DrawCommand(0, 0, 0, 0, 0);
}

uint groupsFor(uint count, uint size, uint window) { return min((count + size - 1) / size, window); }

void main() {
  uint local = gl_LocalInvocationID.x;
  if (local == 0) indices = 0;
  barrier();
  Filling f = push.filling.state;
  uint tubes = f.undoneTube, forks = tubes < f.tubeEnd ? f.firstFork : f.undoneFork;
  FillRoom room = push.room;
  for (uint i = local; i < room.tubeWindow; i += kPlanThreads) keep(i, f.firstTube + i * push.groupSweeps < tubes);
  for (uint i = local; i < room.forkWindow; i += kPlanThreads) keep(room.tubeWindow + i, f.firstFork + i * push.groupForks < forks);
  barrier();
  if (local != 0) return;
  f.rounds += f.firstTube < f.tubeEnd || f.firstFork < f.forkEnd ? 1 : 0;
  f.indices += indices;
  f.blocks += f.taken;
  f.firstTube = tubes;
  f.firstFork = forks;
  f.undoneTube = min(f.tubeEnd, tubes + room.tubeWindow * push.groupSweeps);
  f.undoneFork = min(f.forkEnd, forks + room.forkWindow * push.groupForks);
  f.tubeGroups = groupsFor(f.tubeEnd - tubes, push.groupSweeps, room.tubeWindow);
  f.forkGroups = groupsFor(f.forkEnd - forks, push.groupForks, room.forkWindow);
  f.taken = 0;
  f.spare = int(room.blocks - room.reserve);
  push.filling.state = f;
}
